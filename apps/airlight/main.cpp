#include <fmt/format.h>

#include <array>
#include <cerrno>
#include <csignal>
#include <cstdio>
#include <cstring>
#include <new>

#include "arguments.h"
#include "error.h"
#include "render/version.h"
#include "verbs.h"

namespace {

using airlight::Error;

constexpr int failed = 1;

constexpr const char* examples = R"(Examples:
  airlight render scenes/sunroom.toml -o sunroom.png
  airlight render model.glb -o out.exr --spp 64
  airlight render --help
)";

std::string verb_names() {
  std::string names;
  for (const Verb& verb : verbs) names += (names.empty() ? "" : ", ") + std::string(verb.name);
  return names;
}

/// What the command line lacks or has too much of, in one line.
std::string complaint(const CLI::App& app, const CLI::ParseError& error) {
  const auto chosen = app.get_subcommands();
  if (chosen.empty()) {
    const std::vector<std::string> rest = app.remaining();
    return fmt::format("{}; accepted: {}, --help, --version",
                       rest.empty() ? "a verb is missing" : rest[0] + " is not known here",
                       verb_names());
  }
  const CLI::App& verb = *chosen[0];
  const std::string said = error.what();
  if (error.get_exit_code() == int(CLI::ExitCodes::ArgumentMismatch))
    return fmt::format("{}: {} needs a value", verb.get_name(), said.substr(0, said.find(':')));
  if (error.get_exit_code() != int(CLI::ExitCodes::ExtrasError))
    return fmt::format("{}: {}", verb.get_name(), said);
  std::string accepted;
  for (const CLI::Option* option : verb.get_options())
    accepted += (accepted.empty() ? "" : ", ") + option->get_name();
  const std::vector<std::string> extras = app.remaining(true);
  return fmt::format("{}: {} is not known here; accepted: {}", verb.get_name(),
                     extras.empty() ? "an argument" : extras[0], accepted);
}

int run(int argc, char** argv) {
  CLI::App app("Airlight: light in fog, dust, smoke and water\n", "airlight");
  app.set_version_flag("--version", fmt::format("airlight {}", airlight::version()));
  app.footer(examples);
  app.require_subcommand(1);
  std::array<Action, std::size(verbs)> actions;
  for (std::size_t i = 0; i < std::size(verbs); ++i)
    actions[i] = verbs[i].set_up(*app.add_subcommand(verbs[i].name, verbs[i].meaning));
  try {
    app.parse(arguments(argc, argv));
  } catch (const CLI::Success& help) {
    return app.exit(help);
  } catch (const CLI::ParseError& error) {
    throw Error(complaint(app, error));
  }
  for (std::size_t i = 0; i < std::size(verbs); ++i)
    if (app.got_subcommand(verbs[i].name)) {
      const int status = actions[i]();
      if (std::fflush(stdout) != 0 || std::ferror(stdout))
        throw Error(fmt::format("what was printed cannot be written: {}", std::strerror(errno)));
      return status;
    }
  return failed;
}

int fail(const char* reason, int status) {
  fmt::print(stderr, "{}\n", reason);
  return status;
}

}  // namespace

int main(int argc, char** argv) {
  std::signal(SIGXFSZ, SIG_IGN);  // a file that may not grow is an error like a full disk
  try {
    return run(argc, argv);
  } catch (const Error& error) {
    return fail(error.what(), bad_input);
  } catch (const std::bad_alloc&) {
    return fail("there is not enough memory for this", failed);
  } catch (const std::exception& error) {
    return fail(error.what(), failed);
  }
}
