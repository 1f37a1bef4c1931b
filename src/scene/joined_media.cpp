#include "scene/joined_media.h"

#include <airlight/joined.h>
#include <fmt/format.h>

#include "scene/polyhedron.h"

namespace airlight {

std::optional<std::string> cannot_be_joined(std::span<const Medium> media) {
  if (media.size() < 2) return std::nullopt;
  if (media.size() > Joined::most_parts)
    return fmt::format("are {}; accepted: up to {} side by side", media.size(), Joined::most_parts);
  int faces = 0;
  for (std::size_t i = 0; i < media.size(); ++i) {
    if (Joined::face_count(media[i].shape) == 0)
      return fmt::format(
          "cannot lie side by side, as media.{} is of type {}; accepted: several of type box or "
          "convex, or one alone of any type",
          i, std::visit([](const auto& shape) { return shape.name; }, media[i].shape));
    faces += Joined::face_count(media[i].shape);
  }
  if (faces > Joined::most_faces)
    return fmt::format("have {} faces together; accepted: up to {}", faces, Joined::most_faces);
  for (std::size_t i = 0; i < media.size(); ++i)
    for (std::size_t j = 0; j < i; ++j)
      if (overlap(Joined::as_convex(media[j].shape), Joined::as_convex(media[i].shape)))
        return fmt::format(
            "hold two that overlap, media.{} and media.{}; accepted: media that "
            "touch at most",
            j, i);
  return std::nullopt;
}

}  // namespace airlight
