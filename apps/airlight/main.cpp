#include <CLI/CLI.hpp>

#include "render/version.h"

int main(int argc, char** argv) {
  CLI::App app("Airlight: light in fog, dust, smoke and water", "airlight");
  app.set_version_flag("--version", airlight::version());
  CLI11_PARSE(app, argc, argv);
}
