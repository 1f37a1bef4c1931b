#include <nlohmann/json.hpp>

#include "probe.h"

namespace {

using namespace airlight;
using Json = nlohmann::ordered_json;

Json json(const Rgb<double>& c) { return {c.r, c.g, c.b}; }
Json json(const Vec3<double>& v) { return {v.x, v.y, v.z}; }
Json json(const std::optional<double>& x) { return x ? Json(*x) : Json(nullptr); }

Json json(const Estimate<double>& e) {
  return {{"plain", json(e.plain)},
          {"analytic", json(e.analytic)},
          {"occluded", json(e.occluded)},
          {"unoccluded", json(e.unoccluded)}};
}

Json json(const ProbedNode& n) {
  return {{"t", n.t}, {"length", n.length}, {"optical_depth", json(n.optical_depth)}};
}

Json json(const ProbedSample& s) {
  return {{"index", s.index},
          {"t", s.t},
          {"pdf", s.pdf},
          {"weight", json(s.weight)},
          {"visibility", json(s.visibility)}};
}

Json json(const ProbedStep& s) {
  return {{"t", s.t},
          {"pdf", s.pdf},
          {"transmittance", json(s.transmittance)},
          {"visibility", json(s.visibility)}};
}

Json json(const ProbedLight& light);

template <class T>
Json list(const std::vector<T>& items) {
  Json result = Json::array();
  for (const T& item : items) result.push_back(json(item));
  return result;
}

Json json(const ProbedLight& l) {
  return {{"light", l.light},
          {"toward", json(l.toward)},
          {"in_pieces", l.in_pieces},
          {"strength", json(l.strength)},
          {"transmittance_integral", json(l.transmittance_integral)},
          {"nodes", list(l.nodes)},
          {"samples", list(l.samples)},
          {"lit", l.lit},
          {"mean", json(l.mean)},
          {"in_scatter", json(l.mean.radiance())},
          {"steps", list(l.steps)}};
}

Json json(const ProbedRay& r, const Scene& scene) {
  return {{"origin", json(r.origin)},
          {"direction", json(r.direction)},
          {"sample_count", r.sample_count},
          {"hit", json(r.hit)},
          {"object", r.hit ? Json(r.object) : Json(nullptr)},
          {"object_name", r.hit ? Json(scene.objects[r.object].name) : Json(nullptr)},
          {"end", json(r.end)},
          {"t_enter", json(r.t_enter)},
          {"t_exit", r.t_enter ? Json(r.t_exit) : Json(nullptr)},
          {"through", json(r.through)},
          {"surface", json(r.surface)},
          {"emission", json(r.emission)},
          {"lights", list(r.lights)}};
}

}  // namespace

std::string probe_json(const Probe& probe, const Scene& scene) {
  Json rays = Json::array();
  for (const ProbedRay& ray : probe.rays) rays.push_back(json(ray, scene));
  const Json result = {{"pixel", {probe.x, probe.y}},          {"estimator", probe.estimator},
                       {"max_depth", probe.max_depth},         {"mean", json(probe.mean)},
                       {"in_scatter", json(probe.in_scatter)}, {"surface", json(probe.surface)},
                       {"radiance", json(probe.radiance)},     {"rays", std::move(rays)}};
  return result.dump(2, ' ', false, Json::error_handler_t::replace) + "\n";
}
