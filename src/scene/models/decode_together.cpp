#include "scene/models/decode_together.h"

#include <tbb/parallel_for.h>

#include <exception>

namespace airlight {

std::vector<Texture> decode_together(std::span<const std::function<Texture()>> loaders) {
  std::vector<Texture> textures(loaders.size());
  std::vector<std::exception_ptr> problems(loaders.size());
  tbb::parallel_for(std::size_t{0}, loaders.size(), [&](std::size_t i) {
    try {
      textures[i] = loaders[i]();
    } catch (...) {
      problems[i] = std::current_exception();
    }
  });
  for (const std::exception_ptr& problem : problems)
    if (problem) std::rethrow_exception(problem);
  return textures;
}

}  // namespace airlight
