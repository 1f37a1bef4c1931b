#!/bin/bash
# installed_package.sh CMAKE BUILD EXAMPLES WORK [cmake option…]: installs the build into an empty folder of WORK, builds
# the examples against it with find_package and runs them. Then the same for every header of the core, with nothing but
# airlight::core: they have to work alone.
set -euo pipefail
cmake=$1 build=$2 examples=$3 work=$4
shift 4
rm -rf "$work"
mkdir -p "$work/headers"
"$cmake" --install "$build" --prefix "$work/prefix" >/dev/null

build_with_package() {
  "$cmake" -G Ninja -S "$1" -B "$2" -DCMAKE_PREFIX_PATH="$work/prefix" --log-level=NOTICE "${@:3}" >"$work/log" &&
    "$cmake" --build "$2" >>"$work/log" || {
    cat "$work/log"
    return 1
  }
}

build_with_package "$examples" "$work/examples" "$@"
for source in "$examples"/*.cpp; do
  example=$(basename "$source" .cpp)
  echo "== $example"
  (cd "$examples/.." && "$work/examples/$example")
done

cat >"$work/headers/CMakeLists.txt" <<'END'
cmake_minimum_required(VERSION 3.25)
project(core_headers LANGUAGES CXX)
find_package(airlight REQUIRED COMPONENTS core)
if(TARGET embree OR TARGET airlight::airlight)
  message(FATAL_ERROR "the core must not ask for anything but xsimd")
endif()
file(GLOB sources *.cpp)
add_library(core_headers OBJECT ${sources})
target_link_libraries(core_headers PRIVATE airlight::core)
END
core=$(cd "${examples}/../include" && find airlight -name '*.h')
for header in $core; do
  echo "#include <$header>" >"$work/headers/${header//\//_}.cpp"
done
build_with_package "$work/headers" "$work/headers/build" "$@"
echo "== $(wc -w <<<"$core") headers of the core compile alone"
