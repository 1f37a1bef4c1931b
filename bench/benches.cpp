#include "row.h"

namespace airlight::bench {

Bench box_transmittance();

std::vector<Bench> benches() {
  return {
      box_transmittance(),
  };
}

}  // namespace airlight::bench
