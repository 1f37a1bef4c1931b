#include "study/reproduction.h"

#include <fmt/format.h>

#include "error.h"
#include "image/atomic_file.h"
#include "image/output.h"
#include "image/read_file.h"
#include "render/version.h"
#include "report/json.h"

namespace airlight {

Figure Reproduced::picture(const std::string& name, const Image& image,
                           const std::string& caption) const {
  const std::filesystem::path path = folder / (name + ".png");
  write_png(path, picture_of(image));
  return {read_text(path), caption};
}

std::vector<Row> reproduce(const Reproduction& reproduction, const std::filesystem::path& folder,
                           const std::filesystem::path& scene_file) {
  make_folder(folder);
  Reproduced out{.folder = folder,
                 .page = Page(reproduction.title, reproduction.shows),
                 .scene_file = scene_file};
  reproduction.run(out);
  write_text(folder / "result.json", json(out.rows));
  write_text(folder / "index.html", out.page.html(fmt::format("airlight reproduce {}, Airlight {}",
                                                              reproduction.name, version())));
  return out.rows;
}

}  // namespace airlight
