#!/usr/bin/env bash
# What the commands do with bad input: one clear line on stderr, a non-zero exit, and nothing is written:
# errors_test.sh [TEXT], which are then only those tests that have TEXT in their name.
set -uo pipefail

root=$(cd "$(dirname "${BASH_SOURCE[0]}")/../.." && pwd)
work=$(mktemp -d)
trap 'rm -rf "$work"' EXIT
environment=$root/tests/data/forest.exr
passed=0
failed=0
only=${1:-}

# refuses NAME EXPECTED_TEXT COMMAND…: runs ./dev COMMAND in an empty folder and checks how it ends.
refuses() {
  local name=$1 text=$2 status=0 problem=""
  shift 2
  [[ $name == *"$only"* ]] || return 0
  rm -rf "$work/run"
  mkdir "$work/run"
  (cd "$work/run" && timeout 120 "$root/dev" "$@") >"$work/stdout" 2>"$work/stderr" </dev/null || status=$?
  if ((status == 0)); then
    problem="ended with 0"
  elif ((status >= 124)); then
    problem="crashed or took too long (status $status)"
  elif (($(wc -l <"$work/stderr") != 1)); then
    problem="wrote $(wc -l <"$work/stderr") lines to stderr, expected 1"
  elif ! grep -qF -- "$text" "$work/stderr"; then
    problem="does not say '$text'"
  elif [[ -s $work/stdout ]]; then
    problem="wrote to stdout"
  elif [[ -n $(ls -A "$work/run") ]]; then
    problem="left behind: $(ls -A "$work/run")"
  fi
  if [[ -z $problem ]]; then
    passed=$((passed + 1))
    echo "  $name: passed"
  else
    failed=$((failed + 1))
    echo "  $name: FAILED, $problem"
    sed 's/^/    | /' "$work/stdout" "$work/stderr"
  fi
}

# bake_refuses NAME EXPECTED_TEXT OPTION…: ./dev bake with one thing wrong.
bake_refuses() {
  local name=$1 text=$2
  shift 2
  refuses "bake, $name" "$text" bake "$@"
}

compare_refuses() {
  local name=$1 text=$2
  shift 2
  refuses "compare, $name" "$text" compare "$@"
}

refuses "bench runtime, unknown renderer" "there is no renderer 'metal'" bench runtime --renderer metal
refuses "bench runtime, no scale" "--scale must be" bench runtime --scale none
refuses "bench rooms, unknown renderer" "there is no renderer 'metal'" bench rooms --renderer metal
refuses "bench rooms, no probes" "--probes must be" bench rooms --probes none

good_bake=(--brdf ward --lobes 4 --out table.res)
bake_refuses "alpha of zero" "alpha" "${good_bake[@]}" --alpha 0,0.1
bake_refuses "negative alpha" "alpha" "${good_bake[@]}" --alpha 0.1,-0.1
bake_refuses "alpha that is no number" "alpha" "${good_bake[@]}" --alpha 0.1,wide
bake_refuses "alpha that is not finite" "alpha" "${good_bake[@]}" --alpha 0.1,inf
bake_refuses "alpha with three numbers" "alpha" "${good_bake[@]}" --alpha 0.1,0.1,0.1
bake_refuses "no alpha" "alpha" "${good_bake[@]}"
bake_refuses "no lobe" "lobes" --brdf ward --alpha 0.1,0.1 --lobes 0 --out table.res
bake_refuses "a thousand lobes" "lobes" --brdf ward --alpha 0.1,0.1 --lobes 1000 --out table.res
bake_refuses "lobes that are no number" "lobes" --brdf ward --alpha 0.1,0.1 --lobes many --out table.res
bake_refuses "an unknown BRDF" "phong" --brdf phong --alpha 0.1,0.1 --lobes 4 --out table.res
bake_refuses "an unknown method" "guessing" "${good_bake[@]}" --alpha 0.1,0.1 --method guessing
bake_refuses "one view" "views" "${good_bake[@]}" --alpha 0.1,0.1 --views 1,1
bake_refuses "no output" "out" --brdf ward --alpha 0.1,0.1 --lobes 4
bake_refuses "an output with the wrong ending" "table.png" \
  --brdf ward --alpha 0.1,0.1 --lobes 4 --out table.png
bake_refuses "an output in a missing folder" "missing/table.res" \
  --brdf ward --alpha 0.1,0.1 --lobes 4 --out missing/table.res
bake_refuses "an unknown option" "--colour" "${good_bake[@]}" --alpha 0.1,0.1 --colour red
bake_refuses "an option without a value" "--alpha" "${good_bake[@]}" --alpha
bake_refuses "a missing recipe" "no_recipe.json" --recipe no_recipe.json --out table.res

bake_refuses "a target without auto" "auto" "${good_bake[@]}" --alpha 0.1,0.1 --target 30
bake_refuses "a target that is no number" "target" \
  --brdf ward --alpha 0.1,0.1 --lobes auto --target high --out table.res

refuses "bake-tables, an unknown BRDF" "phong" bake-tables --brdf phong --out .
refuses "bake-tables, no lobe" "lobes" bake-tables --lobes 0 --out .
refuses "bake-tables, one width" "widths" bake-tables --widths 1 --out .
refuses "bake-tables, no azimuth" "azimuth" bake-tables --views 4,0 --out .
refuses "bake-tables, a missing folder" "missing" bake-tables --out missing
refuses "bake-tables, nothing to check" "ward_8.res" bake-tables --check --out .

echo "This is text, not a file of measurements." >"$work/text.binary"
echo "This is text, not a file of measurements." >"$work/text.bsdf"
: >"$work/empty.binary"
printf 'Z\0\0\0Z\0\0\0\264\0\0\0and no numbers' >"$work/cut.binary"
printf 'tensor_file\0\1\0\377\377\377\377' >"$work/greedy.bsdf"
measured=(--lobes 4 --out table.res)
bake_refuses "measurements that do not exist" "nowhere.binary" "${measured[@]}" --brdf nowhere.binary
bake_refuses "text in a .binary" "text.binary" "${measured[@]}" --brdf "$work/text.binary"
bake_refuses "text in a .bsdf" "text.bsdf" "${measured[@]}" --brdf "$work/text.bsdf"
bake_refuses "an empty .binary" "empty.binary" "${measured[@]}" --brdf "$work/empty.binary"
bake_refuses "a .binary that is cut off" "cut.binary" "${measured[@]}" --brdf "$work/cut.binary"
bake_refuses "a .bsdf of four billion fields" "4294967295" "${measured[@]}" --brdf "$work/greedy.bsdf"
bake_refuses "a folder for measurements" "is a folder" "${measured[@]}" --brdf "$work/"

good_compare=(--brdf ward --alpha "0.1,0.1" --size 16 --out pictures)
echo "This is text, not a picture." >"$work/text.exr"
echo "This is text, not a picture." >"$work/text.hdr"
head -c 3000 "$environment" >"$work/cut.exr"
: >"$work/empty.exr"
compare_refuses "a missing environment" "nowhere.exr" "${good_compare[@]}" --methods gmm4 --env nowhere.exr
compare_refuses "no environment" "env" "${good_compare[@]}" --methods gmm4
compare_refuses "text in an .exr" "text.exr" "${good_compare[@]}" --methods gmm4 --env "$work/text.exr"
compare_refuses "text in a .hdr" "text.hdr" "${good_compare[@]}" --methods gmm4 --env "$work/text.hdr"
compare_refuses "an EXR that is cut off" "cut.exr" "${good_compare[@]}" --methods gmm4 --env "$work/cut.exr"
compare_refuses "a map wider than textures" "20000_wide.hdr: has 20000 texels along a side; a texture holds 16384" \
  "${good_compare[@]}" --methods gmm4 --env "$root/tests/data/field/20000_wide.hdr"
compare_refuses "an empty file" "empty.exr" "${good_compare[@]}" --methods gmm4 --env "$work/empty.exr"
compare_refuses "a folder for an environment" "$work" "${good_compare[@]}" --methods gmm4 --env "$work"
compare_refuses "an unknown form of importance sampling" "--fis is best" \
  "${good_compare[@]}" --methods fis8 --fis newest --env "$environment"
compare_refuses "a light that there is not" "--light is live or baked" \
  "${good_compare[@]}" --methods gmm4 --light dim --env "$environment"
compare_refuses "more sources than materials draw" "max-sources" \
  "${good_compare[@]}" --methods gmm4 --max-sources 5 --env "$environment"
compare_refuses "an unknown method" "magic8" "${good_compare[@]}" --methods magic8 --env "$environment"
compare_refuses "a method without lobes" "gmm0" "${good_compare[@]}" --methods gmm0 --env "$environment"
compare_refuses "a method with a thousand lobes" "1000" \
  "${good_compare[@]}" --methods gmm1000 --env "$environment"
compare_refuses "no method" "methods" "${good_compare[@]}" --env "$environment"
compare_refuses "alpha of zero" "alpha" \
  --brdf ward --alpha 0,0 --size 16 --out pictures --methods gmm4 --env "$environment"
compare_refuses "an unknown BRDF" "phong" \
  --brdf phong --alpha 0.1,0.1 --size 16 --out pictures --methods gmm4 --env "$environment"
compare_refuses "a size of zero" "size" \
  --brdf ward --alpha 0.1,0.1 --size 0 --out pictures --methods gmm4 --env "$environment"
compare_refuses "more coverage than all" "coverage" \
  "${good_compare[@]}" --methods toral8 --env "$environment" --coverage 1
compare_refuses "a negative number of rounds" "timing-rounds" \
  "${good_compare[@]}" --methods gmm4 --env "$environment" --timing-rounds -1
compare_refuses "more views than a table has" "views" \
  "${good_compare[@]}" --methods toral8 --env "$environment" --views 1000,1
compare_refuses "a room and an environment" "--room and --env exclude each other" \
  "${good_compare[@]}" --methods gmm4 --env "$environment" --room room.json
compare_refuses "a missing room" "room.json: there is no such file" "${good_compare[@]}" --methods gmm4 --room room.json
echo '{"size": [6, 3, 8], "walls": {}, "probe": [0, 0, 0], "sphere": {"centre": [0, 0, 0], "radius": 0.4}}' >"$work/bare.json"
compare_refuses "a room without walls" "bare.json: walls.+x is missing" \
  "${good_compare[@]}" --methods gmm4 --room "$work/bare.json"
compare_refuses "a method that is not for rooms" "method asg is not drawn in rooms" \
  "${good_compare[@]}" --methods asg --room "$work/bare.json"
compare_refuses "a method for rooms without one" "method gmm8_flat is for rooms" \
  "${good_compare[@]}" --methods gmm8_flat --env "$environment"
compare_refuses "an unknown renderer" "vulkan9" \
  "${good_compare[@]}" --methods gmm4 --env "$environment" --renderer vulkan9

refuses "demo, an unknown option" "--colour" demo --colour red
refuses "demo, an environment that does not exist" "--env" demo --env 17
refuses "demo, an unknown renderer" "vulkan9" demo --renderer vulkan9
refuses "test, an unknown group" "no-such-group" test no-such-group
refuses "test, a suite that is not there" "no suite 'no_such' in tests/runtime" test runtime:no_such
refuses "test, a suite of a group without" "a suite of 'lint'" test lint:arrows
refuses "test, a test that is not there" "no test 'test_no_such'" test runtime:lobe_table:no_such
refuses "test, no suite" "names no suite" test runtime:
refuses "test, a suite and a group" "not both" test lint runtime:lobe_table
refuses "test, an engine without a version" "must be such as 4.6" test --engine
refuses "engine, a version that is none" "must be such as 4.6" engine newest
refuses "build-library, no vcpkg" "--vcpkg is missing" build-library
refuses "build-library, a folder that is not vcpkg" "is no clone of vcpkg" build-library --vcpkg .
refuses "build-library, an unknown option" "--colour" build-library --colour red
refuses "smoke, an unknown option" "--colour" smoke --colour red
refuses "smoke, a package that is not there" "absent.zip: there is no such file" smoke --package absent.zip
refuses "smoke, JSON in a missing folder" "its folder does not exist" smoke --json missing/s.json
refuses "test, two groups as one" "lint harness" test "lint harness"
refuses "test, an unknown sanitizer" "must be one of address undefined thread" test --sanitize nonsense
refuses "test, no sanitizer" "must be one of address undefined thread" test --sanitize
refuses "test, two sanitizers as one" "address undefined" test --sanitize "address undefined"
refuses "test, a group that is not sanitized" "not 'render'" test --sanitize address render
refuses "test, the engine under the thread sanitizer" "not 'native'" test --sanitize thread native
refuses "stability, an unknown option" "--colour" stability --colour red
refuses "stability, an unknown group" "no-such-group" stability --group no-such-group
refuses "stability, JSON in a missing folder" "missing/cases.json" stability --quick --json missing/cases.json
refuses "accuracy, a map that is not there" "no such map" accuracy --quick --maps absent.exr
refuses "accuracy, a size out of range" "--size" accuracy --size 4
refuses "accuracy, no time" "--minutes" accuracy --minutes 0
refuses "accuracy, an unknown option" "--frames" accuracy --frames 3
refuses "report, an unknown renderer" "vulkan9" report --renderers mobile,vulkan9
refuses "report, an unknown method" "gmm9" report --methods gmm8,gmm9
refuses "report, no time" "--minutes" report --minutes 0
refuses "report, a map that is not there" "no such map" report --quick --maps absent.exr
refuses "report, JSON in a missing folder" "missing/report.json" report --json missing/report.json
DISPLAY="" WAYLAND_DISPLAY="" refuses "report, a GPU without a display" "DISPLAY" report --device
refuses "mobile-cost, an unknown GPU" "no GPU 'adreno1'" mobile-cost --gpus adreno1
refuses "mobile-cost, an unknown variant" "no variant 'gmm9'" mobile-cost --variants gmm9
refuses "mobile-cost, JSON in a missing folder" "missing/rows.json" mobile-cost --json missing/rows.json
refuses "package, an unknown option" "--colour" package --colour red
refuses "package, every library and none" "--no-library" package --all --no-library
refuses "package, an output with the wrong ending" "x.tar" package --out x.tar
refuses "package, an output in a missing folder" "missing/x.zip" package --out missing/x.zip
refuses "release, an unknown option" "--colour" release --colour
refuses "release, a check with an output" "--out" release --check --out release
refuses "release, an output in a missing folder" "missing/release" release --out missing/release
refuses "release, figures in a missing folder" "missing/x.json" release --check --json missing/x.json
refuses "android, an unknown option" "--colour" android --colour red
refuses "android, an output that is a file" "is not a folder" android --out "$environment"
refuses "android, JSON in a missing folder" "missing/a.json" android --json missing/a.json
refuses "web, an unknown option" "--colour" web --colour red
refuses "web, an output that is a file" "is not a folder" web --out "$environment"
refuses "web, JSON in a missing folder" "missing/a.json" web --json missing/a.json
refuses "web, a port that is none" "not 'here'" web --serve here
refuses "web, a port beyond the last" "not '65536'" web --serve 65536
refuses "web, headers without a server" "--isolated goes with --serve" web --isolated
refuses "web-check, an unknown option" "--colour" web-check --colour red
refuses "web-check, an output that is a file" "is not a folder" web-check --out "$environment"
refuses "web-check, JSON in a missing folder" "missing/a.json" web-check --json missing/a.json
refuses "crosscheck-gltf, an unknown option" "--colour" crosscheck-gltf --colour red
refuses "crosscheck-gltf, an unknown renderer" "there is no renderer 'metal'" crosscheck-gltf --renderer metal
refuses "docs, an unknown option" "--colour" docs --colour red
refuses "docs, an output that is a file" "is not a folder" docs --out "$environment"
refuses "docs, an output that holds something else" "something else than a site" docs --out "$root/demo"
refuses "docs, JSON in a missing folder" "missing/a.json" docs --json missing/a.json
refuses "docs, a port that is none" "not 'here'" docs --serve here
refuses "diet, nothing to look at" "SCENE|PROJECT" diet
refuses "diet, a scene that is not there" "absent.tscn" diet absent.tscn
refuses "diet, a file that is no scene" "is not a scene" diet "$root/README.md"
refuses "diet, a folder without a project" "is in no project" diet "$work"
refuses "diet, the acceptance of a scene of one's own" "one too many" diet --acceptance x.tscn
refuses "diet, a report of a quick acceptance" "--quick draws too little" diet --acceptance --quick --out .
refuses "diet, an option of the acceptance" "goes with --acceptance" diet --instructions "$root"
refuses "fuzz, no time" "--minutes" fuzz
refuses "fuzz, no time at all" "above 0" fuzz --minutes 0
refuses "fuzz, an unknown reader" "exr hdr merl rgl measured recipe" fuzz --minutes 1 --reader png
refuses "fuzz, a seed that is no number" "--seed is 'x'" fuzz --minutes 1 --seed x
refuses "house, unknown option" "there is no option '--shout'" house --shout
refuses "house, no JSON file" "--json needs a file name" house --json
refuses "house, JSON in a missing folder" "missing/h.json" house --json missing/h.json
refuses "fuzz, JSON in a missing folder" "missing/f.json" fuzz --minutes 1 --json missing/f.json
refuses "an unknown command" "no-such-command" no-such-command

echo "commands: $passed passed, $failed failed"
((failed == 0))
