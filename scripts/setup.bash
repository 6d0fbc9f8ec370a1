# shellcheck shell=bash
# What tlcomm, env and test share: makes the environment that tlcomm runs in and enters it.
#
# With ROS 2 Jazzy sourced ("sourced") the environment is a virtual environment on top of it;
# otherwise ("private") ROS itself comes from the package index too. All of it is kept in .tlcomm/:
#   <kind>/venv, build, install   what was installed and built
#   <kind>/paths                  what the environment adds to PYTHONPATH and the like
#   <kind>/stamp                  digest of everything that the above was made from, written last
#   <kind>/log/setup.log          output of pip and colcon
# A part that was left unfinished is begun anew, so set-up may be stopped at any moment.

tlcomm_root=$(CDPATH='' cd -- "$(dirname -- "$(readlink -f -- "${BASH_SOURCE[0]}")")/.." && pwd -P)
tlcomm_min_python=3.11
tlcomm_max_python=3.12

tlcomm_say() { printf 'tlcomm: %s\n' "$*" >&2; }

tlcomm_fail() {
  tlcomm_say "$*"
  exit 2
}

# --- What there is ------------------------------------------------------------------------------

tlcomm_choose_kind() {
  tlcomm_ros_prefix=
  case ${ROS_DISTRO:-} in
    '') tlcomm_kind=private ;;
    jazzy)
      tlcomm_kind=sourced
      tlcomm_find_ros_prefix
      ;;
    *) tlcomm_fail "ROS 2 Jazzy is needed, but $ROS_DISTRO is sourced: source Jazzy instead," \
      "or use a shell without ROS, where tlcomm sets up its own" ;;
  esac
  tlcomm_home=$tlcomm_root/.tlcomm/$tlcomm_kind
  tlcomm_venv=$tlcomm_home/venv
}

tlcomm_find_ros_prefix() {
  local -a prefixes
  local prefix
  IFS=: read -ra prefixes <<<"${AMENT_PREFIX_PATH:-}"
  for prefix in "${prefixes[@]}"; do
    if [[ -e $prefix/share/rclpy/package.xml ]]; then
      tlcomm_ros_prefix=$prefix
      return
    fi
  done
  tlcomm_fail "ROS_DISTRO is jazzy, but no rclpy is on AMENT_PREFIX_PATH: source the setup.bash" \
    "of ROS 2 Jazzy, or unset ROS_DISTRO to let tlcomm set up its own"
}

# Everything that the environment depends on but the Python packages' sources, which it links to.
# The root is part of it because virtual environments and CMake record absolute paths.
tlcomm_inputs() {
  printf '%s\n' "$tlcomm_root" "$tlcomm_kind" "$tlcomm_ros_prefix"
  cd -- "$tlcomm_root" || return
  sha256sum scripts/setup.bash scripts/relocate_exports.cmake \
    requirements/{bootstrap,"$tlcomm_kind",cmake}.lock \
    ros2_ws/src/*/package.xml ros2_ws/src/*/setup.* ros2_ws/src/*/CMakeLists.txt \
    ros2_ws/src/*/{msg,srv}/*
}

tlcomm_digest() {
  local digest
  digest=$(tlcomm_inputs | sha256sum) || tlcomm_fail "incomplete checkout: $tlcomm_root"
  printf '%s' "${digest%% *}"
}

# Whether the file $1 holds the digest $2 (bash reads it itself: no process is started).
tlcomm_holds() {
  local held=
  [[ -r $1 ]] && read -r held <"$1" || true
  [[ $held == "$2" ]]
}

# --- What set-up needs --------------------------------------------------------------------------

# (Throughout, -I keeps PYTHONPATH and the user's own packages out of set-up.)
tlcomm_python_version() {
  "$1" -I -c 'import sys; print("%d.%d" % sys.version_info[:2])' 2>/dev/null || true
}

tlcomm_choose_python() {
  local candidate version seen=
  local -a candidates=(
    ${TLCOMM_PYTHON:+"$TLCOMM_PYTHON"} "python$tlcomm_max_python" "python$tlcomm_min_python" python3
  )
  # The modules of a sourced ROS are built for one Python, the one that imports them.
  if [[ $tlcomm_kind == sourced ]]; then candidates=(python3); fi
  for candidate in "${candidates[@]}"; do
    version=$(tlcomm_python_version "$candidate")
    case $version in
      "$tlcomm_min_python" | "$tlcomm_max_python")
        tlcomm_python=$candidate
        tlcomm_python_series=$version
        return
        ;;
      '') ;;
      *) seen=" (python3 is $version)" ;;
    esac
  done
  tlcomm_fail "Python $tlcomm_min_python or $tlcomm_max_python is needed and was not found$seen:" \
    "install one (Debian, Ubuntu: apt install python3 python3-venv python3-dev)" \
    "and put it on the PATH"
}

tlcomm_check_python() {
  "$tlcomm_python" -I -c 'import ensurepip, venv' 2>/dev/null ||
    tlcomm_fail "Python's venv module is missing:" \
      "install it (Debian, Ubuntu: apt install python$tlcomm_python_series-venv)"
  "$tlcomm_python" -I -c 'import os, sysconfig
os.stat(os.path.join(sysconfig.get_path("include"), "Python.h"))' 2>/dev/null ||
    tlcomm_fail "Python's header files are missing:" \
      "install them (Debian, Ubuntu: apt install python$tlcomm_python_series-dev)"
  if [[ $tlcomm_kind == sourced ]]; then
    "$tlcomm_python" -c 'import rclpy' 2>/dev/null ||
      tlcomm_fail "ROS_DISTRO is jazzy, but $(command -v "$tlcomm_python") cannot import rclpy:" \
        "leave other virtual environments and source the setup.bash of ROS 2 Jazzy again"
  fi
}

tlcomm_check_compiler() {
  local compiler
  for compiler in ${CXX:+"$CXX"} c++ g++ clang++; do
    # CXX may carry options; its first word is the program.
    if command -v "${compiler%% *}" >/dev/null; then return; fi
  done
  tlcomm_fail "a C++ compiler is needed to build the messages:" \
    "install one (Debian, Ubuntu: apt install g++)"
}

tlcomm_check_platform() {
  local machine
  machine=$(uname -s)-$(uname -m)
  if [[ $tlcomm_kind == private && $machine != Linux-x86_64 ]]; then
    tlcomm_fail "ROS 2 Jazzy is on the package index for x86_64 Linux only, and this is $machine:" \
      "install ROS 2 Jazzy and source its setup.bash"
  fi
}

tlcomm_check_disk() {
  local needed_mb=2000 free_kb
  if [[ $tlcomm_kind == sourced ]]; then needed_mb=800; fi
  free_kb=$(df -Pk -- "$tlcomm_home" | awk 'NR == 2 { print $4 }')
  if ((free_kb < needed_mb * 1024)); then
    tlcomm_fail "set-up needs $needed_mb MB on the disk of $tlcomm_root, which has" \
      "$((free_kb / 1024)) MB left: make room or move the checkout"
  fi
}

# --- Steps --------------------------------------------------------------------------------------

# tlcomm_step N/M "what is done" COMMAND ARGS…: output into the log, its tail shown on failure.
# (set -e is off inside a step, as bash has it for tested commands: steps chain by && instead.)
tlcomm_step() {
  local number=$1 what=$2 from=$SECONDS status=0
  printf 'tlcomm: [%s] %s … ' "$number" "$what" >&2
  printf '\n=== %s\n' "$what" >>"$tlcomm_log"
  ("${@:3}") >>"$tlcomm_log" 2>&1 </dev/null || status=$?
  if ((status == 0)); then
    printf '%d s\n' "$((SECONDS - from))" >&2
    return
  fi
  printf 'failed\n' >&2
  tlcomm_explain "$what"
}

# Ends with the one line that helps, where the log tells what it is.
tlcomm_explain() {
  local -r this_step=$(tac -- "$tlcomm_log" | sed '/^=== /q')
  case $this_step in
    *'No space left on device'*)
      tlcomm_fail "the disk of $tlcomm_root is full: make room and run the same command again" ;;
    *'connection broken by'* | *'Could not fetch URL'*)
      tlcomm_fail "no package index can be reached: check the network, PIP_INDEX_URL and pip's" \
        "configuration, then run the same command again (log: $tlcomm_log)" ;;
    *'DO NOT MATCH THE HASHES'*)
      tlcomm_fail "the package index serves a file other than the locked one (log: $tlcomm_log)" ;;
  esac
  tail -n 25 -- "$tlcomm_log" >&2
  tlcomm_fail "set-up failed at: $1 (log: $tlcomm_log)"
}

tlcomm_pip() {
  # Downloads are unpacked where the disk was checked; /tmp may be small.
  TMPDIR=$tlcomm_home/tmp "$tlcomm_venv/bin/python" -I -m pip --disable-pip-version-check \
    --no-input install --progress-bar off --require-hashes --no-build-isolation --use-pep517 \
    --only-binary :all: --no-binary empy "$@"
}

tlcomm_make_venv() {
  local -a options=()
  if [[ $tlcomm_kind == sourced ]]; then options=(--system-site-packages); fi
  rm -rf -- "$tlcomm_venv" &&
    "$tlcomm_python" -I -m venv "${options[@]}" "$tlcomm_venv" &&
    tlcomm_pip -r "$tlcomm_root/requirements/bootstrap.lock"
}

tlcomm_has_build_tools() {
  local version
  command -v ninja >/dev/null || return 1
  version=$(cmake --version 2>/dev/null | awk 'NR == 1 { print $3 }')
  # DEFER needs 3.19; 4 refuses what some of the ROS packages ask for.
  [[ $version =~ ^3\.([0-9]+)\. ]] && ((BASH_REMATCH[1] >= 19))
}

tlcomm_fill_venv() {
  local -a locks=(-r "$tlcomm_root/requirements/$tlcomm_kind.lock")
  tlcomm_has_build_tools || locks+=(-r "$tlcomm_root/requirements/cmake.lock")
  tlcomm_pip "${locks[@]}"
}

tlcomm_build() {
  rm -rf -- "$tlcomm_home/build" "$tlcomm_home/install" || return
  # Nothing of the user's colcon or CMake settings may leak into this build.
  unset COLCON_DEFAULTS_FILE CMAKE_GENERATOR CMAKE_TOOLCHAIN_FILE
  export COLCON_HOME=$tlcomm_home/colcon
  # Otherwise colcon has ninja hold back while the machine has other work.
  MAKEFLAGS=-j$(nproc)
  export MAKEFLAGS
  if [[ $tlcomm_kind == private ]]; then export CMAKE_PREFIX_PATH=$tlcomm_venv; fi
  tlcomm_export_base
  python -m colcon --log-base "$tlcomm_home/log/colcon" build \
    --base-paths "$tlcomm_root/ros2_ws/src" --build-base "$tlcomm_home/build" \
    --install-base "$tlcomm_home/install" --merge-install --symlink-install \
    --cmake-args -G Ninja -DBUILD_TESTING=OFF -DCMAKE_BUILD_TYPE=Release \
    "-DPython3_EXECUTABLE=$tlcomm_venv/bin/python" \
    "-DCMAKE_PROJECT_INCLUDE=$tlcomm_root/scripts/relocate_exports.cmake"
}

# Writes what colcon's own set-up adds to an empty environment, since asking it takes half a second.
# (Python is named by a relative path because colcon's script breaks at spaces in its folder.)
tlcomm_record_paths() {
  # shellcheck disable=SC2016  # expanded by the inner shell
  env -i "PATH=$tlcomm_venv/bin:$PATH" COLCON_PYTHON_EXECUTABLE=./python \
    _ROS_WHEELS_BOOTSTRAP_COMPLETE=1 bash -c '
      cd -- "$1" && . "$2" >&2
      for name in AMENT_PREFIX_PATH LD_LIBRARY_PATH PYTHONPATH; do
        value=${!name:?not set by colcon}
        printf "%s=%s\n" "$name" "${value%:}"
      done' record "$tlcomm_venv/bin" "$tlcomm_home/install/local_setup.bash" \
    >"$tlcomm_home/paths.new" &&
    mv -- "$tlcomm_home/paths.new" "$tlcomm_home/paths"
}

tlcomm_make_workspace() {
  (tlcomm_build) && tlcomm_record_paths
}

tlcomm_write_stamp() {
  printf '%s\n' "$2" >"$1.new"
  mv -- "$1.new" "$1"
}

tlcomm_locks_digest() {
  local digest
  digest=$(printf '%s\n' "$tlcomm_root" "$tlcomm_ros_prefix" |
    cat - "$tlcomm_root/requirements/"{bootstrap,"$tlcomm_kind",cmake}.lock | sha256sum)
  printf '%s' "${digest%% *}"
}

# --- Set-up -------------------------------------------------------------------------------------

tlcomm_lock() {
  exec 9>"$tlcomm_root/.tlcomm/lock"
  if ! flock --nonblock 9; then
    tlcomm_say "waiting for another set-up of this checkout to finish"
    flock 9
  fi
}

tlcomm_set_up() {
  local digest locks
  digest=$(tlcomm_digest)
  if tlcomm_holds "$tlcomm_home/stamp" "$digest" && [[ -x $tlcomm_venv/bin/python ]]; then
    return
  fi
  # The marker keeps a colcon that is called in the root out of this folder.
  if ! { mkdir -p -- "$tlcomm_home/log" "$tlcomm_home/tmp" &&
    touch -- "$tlcomm_root/.tlcomm/COLCON_IGNORE"; } 2>/dev/null; then
    tlcomm_fail "cannot write to $tlcomm_root/.tlcomm: make it writable by $(id -un)"
  fi
  tlcomm_log=$tlcomm_home/log/setup.log
  (
    trap 'printf "\n" >&2; tlcomm_say "interrupted; the next call goes on"; exit 130' INT
    tlcomm_lock
    tlcomm_make_environment "$digest"
  )
}

tlcomm_make_environment() {
  local digest=$1 locks from=$SECONDS
  if tlcomm_holds "$tlcomm_home/stamp" "$digest" && [[ -x $tlcomm_venv/bin/python ]]; then
    return # made by the one that was waited for
  fi
  rm -f -- "$tlcomm_home/stamp"
  : >"$tlcomm_log"
  tlcomm_check_platform
  tlcomm_choose_python
  tlcomm_check_python
  tlcomm_check_compiler
  locks=$(tlcomm_locks_digest)
  if ! tlcomm_holds "$tlcomm_venv/stamp" "$locks" || [[ ! -x $tlcomm_venv/bin/python ]]; then
    tlcomm_check_disk
    tlcomm_say "setting up in $tlcomm_root/.tlcomm (once; two or three minutes at the most)"
    tlcomm_step 1/3 "virtual environment" tlcomm_make_venv
    tlcomm_step 2/3 "locked packages" tlcomm_fill_venv
    tlcomm_write_stamp "$tlcomm_venv/stamp" "$locks"
  else
    tlcomm_say "the interfaces or the packages' manifests have changed"
  fi
  tlcomm_step 3/3 "workspace" tlcomm_make_workspace
  tlcomm_write_stamp "$tlcomm_home/stamp" "$digest"
  tlcomm_say "ready after $((SECONDS - from)) s"
}

# tlcomm_set_up_extra NAME "what it is": the packages of NAME.lock, into the same environment.
tlcomm_set_up_extra() {
  local digest stamp=$tlcomm_venv/$1_stamp
  digest=$(sha256sum <"$tlcomm_root/requirements/$1.lock")
  if tlcomm_holds "$stamp" "${digest%% *}"; then return; fi
  tlcomm_log=$tlcomm_home/log/setup.log
  (
    tlcomm_lock
    if tlcomm_holds "$stamp" "${digest%% *}"; then exit; fi
    tlcomm_step "$1" "$2" tlcomm_pip -r "$tlcomm_root/requirements/$1.lock"
    tlcomm_write_stamp "$stamp" "${digest%% *}"
  )
}

# --- Entering -----------------------------------------------------------------------------------

# tlcomm_prepend NAME VALUE: puts VALUE before what the variable NAME holds, once.
tlcomm_prepend() {
  local held=${!1:-}
  if [[ :$held: == *:"$2":* ]]; then return; fi
  export "$1=$2${held:+:$held}"
}

# What both the build and all later processes need.
tlcomm_export_base() {
  local folder
  tlcomm_prepend PATH "$tlcomm_venv/bin"
  export VIRTUAL_ENV=$tlcomm_venv PYTHONNOUSERSITE=1
  unset PYTHONHOME
  if [[ $tlcomm_kind == sourced ]]; then
    # The locked packages come before any of the same names that PYTHONPATH leads to.
    for folder in "$tlcomm_venv"/lib/python3.*/site-packages; do
      tlcomm_prepend PYTHONPATH "$folder"
    done
    return
  fi
  # Modules of another environment must not shadow the locked ones.
  unset PYTHONPATH
  export AMENT_PREFIX_PATH=$tlcomm_venv RMW_IMPLEMENTATION=rmw_fastrtps_cpp
  tlcomm_library_path=$tlcomm_venv/lib
  for folder in "$tlcomm_venv"/lib/python3.*/site-packages/ros_*.libs; do
    tlcomm_library_path+=:$folder
  done
  tlcomm_prepend LD_LIBRARY_PATH "$tlcomm_library_path"
  # Tells the packages' start-up hook that the libraries' folders are set: without it, every
  # Python process would set them and start itself a second time.
  export _ROS_WHEELS_BOOTSTRAP_COMPLETE=1
}

tlcomm_enter() {
  local name value
  tlcomm_export_base
  while IFS='=' read -r name value; do
    tlcomm_prepend "$name" "$value"
  done <"$tlcomm_home/paths"
  # A middleware must be named, or a machine with several may pick different ones per process.
  export RMW_IMPLEMENTATION=${RMW_IMPLEMENTATION:-rmw_fastrtps_cpp}
  export ROS_LOG_DIR=${ROS_LOG_DIR:-$tlcomm_home/log/ros}
}

tlcomm_choose_kind
tlcomm_set_up
