#!/bin/bash
# installed_package.sh CMAKE BUILD EXAMPLES WORK [cmake option…]: installs the build into an empty folder of WORK, builds
# the examples against it with find_package and runs them, and compiles every installed header by itself.
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
# Example → its arguments, and what it must print: a regular expression for some line.
declare -A arguments=([load_and_render]="scenes/cube_of_fog.toml")
declare -A prints=(
  [closed_form_box]='^unshadowed +closed form +0\.170690 '
  [load_and_render]='^pixel 32,32: 0\.02342 0\.02342 0\.02342 '  # the value that the scene states
  [print_version]='^Airlight [0-9]+\.[0-9]+\.[0-9]+$'
)
for source in "$examples"/*.cpp; do
  example=$(basename "$source" .cpp)
  echo "== $example"
  # shellcheck disable=SC2086  # arguments are words
  output=$(cd "$examples/.." && "$work/examples/$example" ${arguments[$example]:-})
  echo "$output"
  grep -Eq "${prints[$example]}" <<<"$output" || {
    echo "-- expected a line like ${prints[$example]}"
    exit 1
  }
done

# Every installed header compiles alone: the core's with nothing but airlight::core.
cat >"$work/headers/CMakeLists.txt" <<'END'
cmake_minimum_required(VERSION 3.25)
project(headers LANGUAGES CXX)
find_package(airlight REQUIRED COMPONENTS core)
if(TARGET embree OR TARGET airlight::airlight)
  message(FATAL_ERROR "the core must not ask for anything but xsimd")
endif()
file(GLOB core core/*.cpp)
add_library(core OBJECT ${core})
target_link_libraries(core PRIVATE airlight::core)
target_precompile_headers(core PRIVATE <xsimd/xsimd.hpp>)  # all of them come to it, and it is most of the work
find_package(airlight REQUIRED)
file(GLOB rooms rooms/*.cpp)
add_library(rooms OBJECT ${rooms})
target_link_libraries(rooms PRIVATE airlight::airlight)
END
mkdir "$work/headers/core" "$work/headers/rooms"
count=0
while read -r header; do
  kind=rooms
  [[ -e $examples/../include/$header ]] && kind=core
  echo "#include <$header>" >"$work/headers/$kind/${header//\//_}.cpp"
  count=$((count + 1))
done < <(cd "$work/prefix/include" && find airlight -name '*.h')
build_with_package "$work/headers" "$work/headers/build" "$@"
echo "== $count headers compile alone"
