#pragma once
#include <string_view>

#include "estimators/closed_form.h"
#include "estimators/sampled.h"

namespace airlight::inline AIRLIGHT_ISA {

/// Every estimator there is. To add one: its file in estimators/ and its name here.
using Estimators = std::variant<Sampled, ClosedForm>;

static_assert(Estimator<Sampled> && Estimator<ClosedForm>);

/// The field's short names for a placement with a form.
struct ShortName {
  const char* name;
  const char* placement;
  const char* form;
};

inline constexpr ShortName short_names[] = {
    {"rm", Equidistant::name, MonteCarlo::name},     {"mcds", Distance::name, MonteCarlo::name},
    {"mcwvds", WholeVolume::name, MonteCarlo::name}, {"rees", Equidistant::name, Ratio::name},
    {"reds", Distance::name, Ratio::name},           {"rewv", WholeVolume::name, Ratio::name},
};

/// The member of a family with this name, default-constructed; nothing if there is none.
template <class Family>
std::optional<Family> member_named(std::string_view name) {
  std::optional<Family> found;
  [&]<class... Members>(const std::variant<Members...>*) {
    ((name == Members::name ? void(found = Members{}) : void()), ...);
  }(static_cast<const Family*>(nullptr));
  return found;
}

/// An estimator by its name, by a short name, or as placement+form; nothing if there is none.
inline std::optional<Estimators> estimator_named(std::string_view name) {
  if (name == ClosedForm::name) return ClosedForm{};
  for (const ShortName& s : short_names)
    if (name == s.name)
      return Sampled{*member_named<Placements>(s.placement), *member_named<Forms>(s.form)};
  const auto plus = name.find('+');
  if (plus == name.npos) return std::nullopt;
  const auto placement = member_named<Placements>(name.substr(0, plus));
  const auto form = member_named<Forms>(name.substr(plus + 1));
  if (!placement || !form) return std::nullopt;
  return Sampled{*placement, *form};
}

}  // namespace airlight::inline AIRLIGHT_ISA
