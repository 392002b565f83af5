# Shared by tools/run and tools/test: installs what is missing, configures and builds a preset. Sourced, not run.

root=$(cd "$(dirname "${BASH_SOURCE[0]}")/../.." && pwd)

packages=(
  g++ cmake ninja-build pkg-config
  libopenmpi-dev openmpi-bin libhdf5-openmpi-dev libeigen3-dev libpugixml-dev libfmt-dev libcli11-dev
  nlohmann-json3-dev libmuparser-dev libxxhash-dev libtbb-dev libpetsc-real-dev libsuitesparse-dev
)
test_packages=(
  libgtest-dev libxml2-utils python3 python3-venv python3-h5py python3-matplotlib clang-format universal-ctags
  python3-markdown-it python3-scipy python3-setuptools python3-wheel dpkg-dev qemu-user
)

say() { printf '%s\n' "tushar: $*" >&2; }

missing_packages() {
  local package
  for package in "$@"; do
    case "$(dpkg-query -W -f '${Status}' "$package" 2>/dev/null)" in
      'install ok installed') ;;
      *) printf '%s\n' "$package" ;;
    esac
  done
}

# install_missing PACKAGE...: nothing to do where there is no dpkg; then cmake says what it misses.
install_missing() {
  command -v dpkg-query >/dev/null || { say "this is not Debian; the packages needed are: $*"; return 0; }
  local missing sudo=
  mapfile -t missing < <(missing_packages "$@")
  [ ${#missing[@]} -eq 0 ] && return 0
  if [ "$(id -u)" -ne 0 ]; then
    if command -v sudo >/dev/null && sudo -n true 2>/dev/null; then sudo=sudo; else
      say "these Debian packages are missing, and installing them takes root: ${missing[*]}"
      say "please run: sudo apt-get update && sudo apt-get install --no-install-recommends ${missing[*]}"
      exit 1
    fi
  fi
  say "installing ${missing[*]}"
  export DEBIAN_FRONTEND=noninteractive
  local log
  log=$(mktemp)
  if ! { $sudo apt-get update -qq &&
    $sudo apt-get install -y -qq --no-install-recommends "${missing[@]}"; } >"$log" 2>&1; then
    tail -n 20 "$log" >&2
    say "apt-get could not install them (above: its last lines); install them by hand and try again"
    exit 1
  fi
  rm -f "$log"
}

# other_ninja FOLDER: the id of a ninja that builds in the folder without the lock of `locked`, such as one started by
# hand; two at once can damage what ninja notes there. One that has started this script, as by its target `test`, does
# not count: it waits for us.
other_ninja() {
  local id=$BASHPID ancestors=' ' process line
  while [ "${id:-0}" -gt 1 ]; do
    ancestors+="$id "
    line=$(grep '^PPid:' "/proc/$id/status" 2>/dev/null) || break
    id=${line##*[[:space:]]}
  done
  for process in /proc/[0-9]*; do
    id=${process#/proc/}
    { read -r line <"$process/comm"; } 2>/dev/null || continue
    if [ "$line" = ninja ] && [ "$process/cwd" -ef "$1" ] && [[ $ancestors != *" $id "* ]]; then
      printf '%s\n' "$id"
      return 0
    fi
  done
  return 1
}

# locked FOLDER COMMAND...: runs the command while no other build in the folder is under way. What it starts must close
# descriptor 9, or a process that outlives the build keeps the lock.
locked() (
  folder=$1
  shift
  exec 9>"$folder/.building"
  if ! flock -n 9; then
    say "waiting for another build in ${folder#"$root"/} to end"
    flock 9
  fi
  if id=$(other_ninja "$folder"); then
    say "waiting for ninja, process $id, to end its build in ${folder#"$root"/}"
    while other_ninja "$folder" >/dev/null; do sleep 0.2 9>&-; done
  fi
  "$@"
)

# run_ninja FOLDER LOG [TARGET...]: builds, and says how far it is once there is something to build, not before: on a
# terminal in one line that is rewritten, in a log each minute (or each $building_each seconds). What it builds is
# $building, else the folder. If $must_build is set, there is something to build for sure, and it says so at once:
# ninja names a file only when it is done, which may take minutes.
run_ninja() {
  local folder=$1 log=$2 what=${building:-${1#"$root"/}} said= line
  shift 2
  if [ -n "${must_build:-}" ]; then
    if [ -t 2 ]; then printf '\r\033[Ktushar: building %s' "$what" >&2; else say "building $what"; fi
    said=$SECONDS
  fi
  NINJA_STATUS='[%f/%t] ' ninja -C "$folder" "$@" 2>&1 9>&- | {
    while IFS= read -r line; do
      printf '%s\n' "$line" >>"$log"
      if [[ $line =~ ^\[([0-9]+)/([0-9]+)\]\ (Building|Linking)\  ]]; then
        local at=": ${BASH_REMATCH[1]} of ${BASH_REMATCH[2]}"
        if [ -t 2 ]; then
          printf '\r\033[Ktushar: building %s' "$what$at" >&2
        elif [ -z "$said" ]; then
          say "building $what"
        elif [ $((SECONDS - said)) -ge "${building_each:-60}" ]; then
          say "building $what$at"
        else
          continue
        fi
        said=$SECONDS
      fi
    done
    if [ -t 2 ] && [ -n "$said" ]; then printf '\n' >&2; fi
  }
  return "${PIPESTATUS[0]}"
}

# check_place FOLDER: ends with a sentence if the folder was made for another place of the tree, before it was copied or
# moved. ninja would write to that place, again and again.
check_place() {
  local home
  home=$(sed -n 's/^CMAKE_HOME_DIRECTORY:INTERNAL=//p' "$1/CMakeCache.txt" 2>/dev/null) || true
  if [ -n "$home" ] && [ ! "$home" -ef "$root" ]; then
    say "${1#"$root"/} was made for $home, before the tree was copied or moved; delete it: rm -r $1"
    exit 1
  fi
}

# configure_and_build PRESET LOG [TARGET...]: configures where that has not been done, then builds.
configure_and_build() {
  local preset=$1 log=$2
  shift 2
  if [ ! -f "$root/build/$preset/build.ninja" ]; then
    say "configuring and building build/$preset, which takes some minutes the first time"
    (cd "$root" && cmake --preset "$preset") >"$log" 2>&1 9>&- || return 1
  fi
  run_ninja "$root/build/$preset" "$log" "$@"
}

# build PRESET [TARGET...]: configures where that has not been done, then builds. One build in a folder at a time.
build() {
  local preset=$1 folder=$root/build/$1 log
  shift
  if [ -d "$folder" ] && [ ! -w "$folder" ] && [ -x "$folder/sus" ]; then
    say "build/$preset is not yours to write: sus is taken as it is there"
    return 0
  fi
  check_place "$folder"
  mkdir -p "$folder"
  log=$(mktemp)
  if ! locked "$folder" configure_and_build "$preset" "$log" "$@"; then
    cat "$log" >&2
    say "the build failed"
    exit 1
  fi
  rm -f "$log"
}

# built_modules PRESET: targets of the modules that an earlier run has built; those must not stay behind their sources.
built_modules() {
  local folder=$root/build/$1 file name
  [ -f "$folder/build.ninja" ] || return 0
  check_place "$folder" 2>/dev/null  # `build` says it
  # A module that was removed from the sources, as by another branch, is no target of the new build.ninja.
  if [ -w "$folder" ]; then locked "$folder" run_ninja "$folder" /dev/null build.ninja || true; fi
  for file in "$folder"/modules/tushar_*.so "$folder"/libtushar_petsc.so; do
    name=$(basename "$file" .so)
    if [ -f "$file" ] && grep -q "^build ${name#lib}:" "$folder/build.ninja"; then printf '%s\n' "${name#lib}"; fi
  done
}

# vtk_python: a Python of our own in build/python with the newest libraries that the package tushar can work with, and
# with the XDMF reader that ParaView has; Debian's vtk lacks it. Without a network the tests that need it are skipped,
# and say so.
vtk_python() {
  local python=$root/build/python
  local libraries=(vtk h5py matplotlib scipy pandas xarray pyvista yt nbclient ipykernel mypy)
  "$python/bin/python3" -c 'import h5py, vtkmodules.vtkIOXdmf2, pandas, pyvista, yt, nbclient, mypy' 2>/dev/null &&
    return 0
  say "installing VTK, pandas, xarray, pyvista and yt for the tests of Python into build/python"
  if ! { python3 -m venv "$python" &&
    "$python/bin/python3" -m pip install --quiet --disable-pip-version-check "${libraries[@]}"; } >&2; then
    say "that did not work; the tests that need them will be skipped"
  fi
}

# python_tool NAME VERSION: a program from PyPI, in this very version, in build/python/bin; without a network, none.
python_tool() {
  local python=$root/build/python
  "$python/bin/$1" --version 2>/dev/null | grep -qwF "$2" && return 0
  say "installing $1 $2 into build/python"
  if ! { { [ -x "$python/bin/python3" ] || python3 -m venv "$python"; } &&
    "$python/bin/python3" -m pip install --quiet --disable-pip-version-check "$1==$2"; } >&2; then
    say "that did not work; what needs $1 will be skipped"
  fi
}
