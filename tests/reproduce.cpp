// What `airlight reproduce` lists, writes and gives back. The ranges themselves are the
// reproductions' own; here they have to hold.

#include "study/reproductions.h"

#include <gmock/gmock.h>

#include <nlohmann/json.hpp>
#include <set>

#include "error.h"
#include "support/program.h"

namespace airlight::test {
namespace {

using ::testing::EndsWith;
using ::testing::HasSubstr;
using ::testing::IsEmpty;
using ::testing::Not;
using ::testing::SizeIs;
using ::testing::StartsWith;

const std::string png_signature = "\x89PNG\r\n\x1a\n";

/// The cheap ones; the others are for `airlight reproduce 000`.
constexpr const char* cheap[] = {"000/fig1b", "000/fig4", "000/fig5", "000/fig6-single",
                                 "000/fig11"};

/// What a row of result.json must have.
void expect_row(const nlohmann::json& row) {
  std::set<std::string> keys;
  for (const auto& [key, value] : row.items()) keys.insert(key);
  EXPECT_EQ(keys, (std::set<std::string>{"label", "published", "measured", "low", "high"})) << row;
  EXPECT_FALSE(row["label"].get<std::string>().empty());
  EXPECT_TRUE(row["published"].is_null() || row["published"].is_number()) << row;
  EXPECT_TRUE(row["measured"].is_number()) << row;
  // A range without an end has null there.
  if (!row["low"].is_null()) {
    EXPECT_LE(row["low"].get<double>(), row["measured"].get<double>()) << row;
  }
  if (!row["high"].is_null()) {
    EXPECT_GE(row["high"].get<double>(), row["measured"].get<double>()) << row;
  }
}

TEST(Reproduce, lists_what_there_is) {
  const Outcome listed = run({"reproduce"});
  EXPECT_EQ(listed.status, 0);
  EXPECT_THAT(listed.err, IsEmpty());
  for (const Reproduction& r : reproductions()) {
    EXPECT_THAT(listed.out, HasSubstr(r.name));
    EXPECT_THAT(listed.out, HasSubstr(r.shows));
  }
}

TEST(Reproduce, holds_the_published_numbers_and_writes_a_page_with_pictures) {
  for (const char* name : cheap) {
    const Folder folder;
    const Outcome done = run({"reproduce", name, "-o", folder / "out"});
    EXPECT_EQ(done.status, 0) << done.err;
    EXPECT_THAT(done.err, IsEmpty());
    EXPECT_THAT(done.out, StartsWith(std::string(name) + ": "));

    const auto rows = nlohmann::json::parse(bytes_of(folder / "out/result.json"));
    ASSERT_TRUE(rows.is_array());
    EXPECT_THAT(rows, Not(IsEmpty()));
    for (const auto& row : rows) expect_row(row);

    const std::string page = bytes_of(folder / "out/index.html");
    EXPECT_THAT(page, StartsWith("<!DOCTYPE html>"));
    EXPECT_THAT(page, HasSubstr("✓ holds"));
    EXPECT_THAT(page, Not(HasSubstr("✗ fails")));
    int pictures = 0;
    for (const auto& entry : std::filesystem::directory_iterator(folder / "out"))
      if (entry.path().extension() == ".png") {
        EXPECT_THAT(bytes_of(entry.path()), StartsWith(png_signature));
        ++pictures;
      }
    EXPECT_GT(pictures, 0) << name;
  }
}

TEST(Reproduce, has_the_five_published_values_of_figure_6_twice) {
  const Folder folder;
  ASSERT_EQ(run({"reproduce", "000/fig6-single", "-o", folder / "out"}).status, 0);
  std::multiset<double> published;
  for (const auto& row : nlohmann::json::parse(bytes_of(folder / "out/result.json")))
    published.insert(row["published"].get<double>());
  EXPECT_EQ(published, (std::multiset<double>{28.12, 28.12, 31.76, 31.76, 32.77, 32.77, 35.01,
                                              35.01, 35.49, 35.49}));
}

TEST(Reproduce, takes_the_beginning_of_names_for_all_below_it) {
  EXPECT_THAT(reproductions_named("000"), SizeIs(reproductions().size()));
  EXPECT_THAT(reproductions_named("000/fig4"), SizeIs(1));
  EXPECT_THROW(reproductions_named("000/fig"), Error);
  EXPECT_THROW(reproductions_named("00"), Error);
}

TEST(Reproduce, names_what_is_accepted_where_a_name_is_unknown) {
  const Folder folder;
  const Outcome refused = run({"reproduce", "000/fig99", "-o", folder / "out"});
  EXPECT_EQ(refused.status, 2);
  EXPECT_THAT(refused.out, IsEmpty());
  EXPECT_THAT(refused.err, StartsWith("000/fig99: "));
  EXPECT_EQ(std::ranges::count(refused.err, '\n'), 1);
  for (const Reproduction& r : reproductions()) EXPECT_THAT(refused.err, HasSubstr(r.name));
  EXPECT_FALSE(std::filesystem::exists(folder / "out"));
}

TEST(Reproduce, shows_a_scene_of_the_user_where_it_can) {
  const Folder folder;
  const Outcome refused =
      run({"reproduce", "000/fig4", "--scene", "room.toml", "-o", folder / "out"});
  EXPECT_EQ(refused.status, 2);
  EXPECT_EQ(refused.err,
            "--scene: 000/fig4 shows a scene of its own; accepted with it: 000/fig9, 000/table2\n");
  const Outcome missing =
      run({"reproduce", "000/fig9", "--scene", folder / "none.toml", "-o", folder / "out"});
  EXPECT_EQ(missing.status, 2);
  EXPECT_THAT(missing.err, StartsWith(folder / "none.toml"));
}

TEST(Reproduce, asks_for_a_folder_that_can_be_made) {
  const Outcome none = run({"reproduce", "000/fig4"});
  EXPECT_EQ(none.status, 2);
  EXPECT_THAT(none.err, HasSubstr("-o DIR"));

  const Folder folder;
  write_bytes(folder / "file", "in the way");
  const Outcome refused = run({"reproduce", "000/fig4", "-o", folder / "file/out"});
  EXPECT_EQ(refused.status, 2);
  EXPECT_THAT(refused.err, StartsWith(folder / "file/out: no folder"));
  EXPECT_EQ(bytes_of(folder / "file"), "in the way");
}

TEST(Reproduction, shows_a_value_that_left_its_range) {
  const Reproduction lost{"000/lost", "Lost", "Nothing.", [](Reproduced& out) {
                            out.rows = {{"kept", 2, 2.1, 1.9, 2.2}, {"lost", {}, 3, 1, 2}};
                            out.page.checks(out.rows);
                          }};
  const Folder folder;
  const std::vector<Row> rows = reproduce(lost, folder / "deep/out");
  ASSERT_THAT(rows, SizeIs(2));
  EXPECT_TRUE(rows[0].holds());
  EXPECT_FALSE(rows[1].holds());
  EXPECT_THAT(bytes_of(folder / "deep/out/index.html"), HasSubstr("✗ fails"));
  const auto written = nlohmann::json::parse(bytes_of(folder / "deep/out/result.json"));
  EXPECT_EQ(
      written[0],
      (nlohmann::json{
          {"label", "kept"}, {"published", 2}, {"measured", 2.1}, {"low", 1.9}, {"high", 2.2}}));
  EXPECT_TRUE(written[1]["published"].is_null());
}

TEST(Reproduction, has_a_name_and_words_of_its_own) {
  std::set<std::string> names, titles;
  for (const Reproduction& r : reproductions()) {
    EXPECT_TRUE(names.insert(r.name).second) << r.name;
    EXPECT_TRUE(titles.insert(r.title).second) << r.title;
    EXPECT_THAT(r.shows, EndsWith("."));
  }
}

}  // namespace
}  // namespace airlight::test
