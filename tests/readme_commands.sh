#!/bin/bash
# readme_commands.sh PROGRAM SOURCE WORK: runs every `./run VERB …` line in the ```sh blocks of SOURCE/README.md and SOURCE/docs/
# with PROGRAM. The folder WORK has what the documents speak of: the project's `scenes`, a `fog.toml`, a `model.obj` and a
# `model.glb`. `./run test`, `./run bench` and `./run help` concern the build and are left to it. A command that fails, or documents
# that name no command at all, are a failure.
set -euo pipefail
program=$1 source=$2 work=$3

# Verb → what keeps it quick: options with values that replace the document's, or `-` for an option to leave out.
declare -A quick=(
  [render]="--size 48x27 --spp 4 --crop - --samples-per-ray -"
  [compare]="--size 32x18 --spp 1,2 --seeds 2 --reference-spp 16"
)

# A binary glTF of one triangle: a header, a chunk of JSON and a chunk of nine floats.
write_glb() {
  local json='{"asset":{"version":"2.0"},"scene":0,"scenes":[{"nodes":[0]}],"nodes":[{"mesh":0}],'
  json+='"meshes":[{"primitives":[{"attributes":{"POSITION":0}}]}],'
  json+='"accessors":[{"bufferView":0,"componentType":5126,"count":3,"type":"VEC3","min":[-1,0,0],"max":[1,1,0]}],'
  json+='"bufferViews":[{"buffer":0,"byteLength":36}],"buffers":[{"byteLength":36}]}'
  while ((${#json} % 4)); do json+=' '; done
  local zero='\0\0\0\0' one='\0\0\x80\x3f' minus_one='\0\0\x80\xbf'
  u32() { printf "\\x$(printf %02x $(($1 & 255)))\\x$(printf %02x $(($1 >> 8)))\\0\\0"; }
  printf glTF && u32 2 && u32 $((28 + ${#json} + 36))
  u32 ${#json} && printf 'JSON%s' "$json"
  u32 36 && printf 'BIN\0'
  printf "$minus_one$zero$zero$one$zero$zero$zero$one$zero"
}

rm -rf "$work"
mkdir -p "$work"
cd "$work"
ln -s "$source/scenes" scenes
cp "$source/scenes/cube_of_fog.toml" fog.toml
printf 'v %s\n' '-1 0 0' '1 0 0' '0 1 0' >model.obj
echo 'f 1 2 3' >>model.obj
write_glb >model.glb

cat >run <<'END'
#!/bin/bash
# The program in the place of ./run, with the options of QUICK.
read -ra quick <<<"$QUICK"
arguments=()
while (($#)); do
  for ((i = 0; i < ${#quick[@]}; i += 2)); do
    [[ $1 == "${quick[i]}" ]] && shift 2 && continue 2
    [[ $1 == "${quick[i]}="* ]] && shift && continue 2
  done
  arguments+=("$1")
  shift
done
for ((i = 0; i < ${#quick[@]}; i += 2)); do
  [[ ${quick[i + 1]} == - ]] || arguments+=("${quick[@]:i:2}")
done
exec "$PROGRAM" "${arguments[@]}"
END
chmod +x run

# Lines of the sh blocks, continued lines joined.
commands_of() {
  awk '/^```/ { inside = ($0 ~ /^```sh *$/); next } inside' "$1" | sed -e ':join' -e '/\\$/N; s/\\\n//; t join'
}

ran=0
failed=0
shopt -s nullglob
for document in "$source/README.md" "$source"/docs/*.md; do
  while IFS= read -r command; do
    [[ $command =~ ^\./run\ +([a-z-]+) ]] || continue
    verb=${BASH_REMATCH[1]}
    case $verb in test | bench | help) continue ;; esac
    echo "== ${document#"$source/"}: $command"
    ran=$((ran + 1))
    PROGRAM=$program QUICK=${quick[$verb]:-} bash -euo pipefail -c "$command" </dev/null || {
      echo "-- exit status $?"
      failed=$((failed + 1))
    }
  done < <(commands_of "$document")
done
echo "$ran commands, $failed failed"
((ran > 0 && failed == 0))
