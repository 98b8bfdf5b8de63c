#!/usr/bin/env bash
# SPDX-FileCopyrightText: 2026 The fcl_kios authors
# SPDX-License-Identifier: BSD-3-Clause
#
# usage: deb.sh SOURCE_DIR BUILD_DIR CMAKE CXX
# Makes the Debian packages of a build whose prefix is /usr, installs them and uses them. They are
# installed by dpkg into a copy-on-write view of this machine, which leaves the machine as it is;
# where that takes rights that we don't have (root, mount namespaces), they are only unpacked.
set -euo pipefail

source_dir=$1 build_dir=$2 cmake=$3 cxx=$4
version=$(<"$source_dir/VERSION")
no_rights=77
fail() {
  echo "$*"
  exit 1
}

case ${5-} in
  mount_view) # in a mount namespace of its own
    view=$6
    {
      mount -t tmpfs none "$view"
      mkdir "$view/upper" "$view/work" "$view/root"
      mount -t overlay overlay -o "lowerdir=/,upperdir=$view/upper,workdir=$view/work" "$view/root"
      mkdir -p "$view/root$source_dir"
      for directory in /proc /dev "$source_dir"; do
        mount --rbind "$directory" "$view/root$directory"
      done
    } 2>/dev/null || exit "$no_rights"
    exec chroot "$view/root" "$source_dir/test/package/deb.sh" "${@:1:4}" install
    ;;
  install) # in the view
    dpkg -i "$build_dir"/*.deb
    ldconfig -p | grep 'libfcl_kios\.so\.' >/dev/null || fail "ldconfig doesn't know the library"
    "$source_dir/test/consumer/use.sh" "$source_dir" /usr "$(mktemp -d)" "$cmake" "$cxx" ""
    # A program that was compiled for FCL alone.
    program=$(mktemp -d)/fcl_program
    read -ra eigen <<<"$(pkg-config --cflags eigen3)"
    "$cxx" -std=c++17 -I"$source_dir/benchmarks" "${eigen[@]}" \
      "$source_dir/test/preload/program.cpp" -o "$program" \
      -lfcl -lccd -loctomap -loctomath -lpthread
    FCL_KIOS_PRELOAD=stats LD_PRELOAD=libfcl_kios_preload.so "$program" write /dev/null \
      threads 2>&1 | grep -E 'distance: [0-9]{2,} by k-IOS' || fail "nothing was preloaded"
    if [[ -n $(find "$build_dir" -maxdepth 1 -name 'python3-fcl-kios*.deb') ]]; then
      /usr/bin/python3 "$source_dir/addons/python/examples/clearance_map.py" | grep 'exact distances' ||
        fail "the Python package doesn't work"
      dpkg --purge python3-fcl-kios
    fi
    if [[ -n $(find "$build_dir" -maxdepth 1 -name 'libfcl-kios-robot*.deb') ]]; then
      "$source_dir/test/robot/use.sh" "$(mktemp -d)" /usr "$cmake" "$cxx" ""
      dpkg --purge libfcl-kios-robot
    fi
    dpkg --purge libfcl-kios-preload libfcl-kios-dev "libfcl-kios${version%.*}"
    left=$(find /usr \( -name '*fcl_kios*' -o -name '*fcl-kios*' \) -print)
    [[ -z $left ]] || fail "left after the packages were removed: $left"
    exit 0
    ;;
esac

rm -f "$build_dir"/*.deb
(cd "$build_dir" && cpack -G DEB >cpack.log 2>&1) || fail "cpack: $(<"$build_dir/cpack.log")"
debs=("$build_dir"/*.deb)
expected=3
if [[ -d $build_dir/python/fcl_kios ]]; then expected=4; fi
if [[ -e $build_dir/addons/robot/libfcl_kios_robot.so ]]; then expected=$((expected + 1)); fi
((${#debs[@]} == expected)) || fail "cpack made ${#debs[@]} packages: ${debs[*]}"
for deb in "${debs[@]}"; do
  depends=$(dpkg-deb -f "$deb" Depends)
  echo "${deb##*/} depends on $depends"
  if command -v lintian >/dev/null; then lintian --fail-on error "$deb" 2>/dev/null; fi
done

view=$(mktemp -d)
trap 'rm -rf "$view"' EXIT
status=$no_rights
if unshare --mount true 2>/dev/null; then
  echo "== dpkg -i, in a view of this machine"
  status=0
  unshare --mount "$0" "$source_dir" "$build_dir" "$cmake" "$cxx" mount_view "$view" || status=$?
fi
if ((status == no_rights)); then
  echo "== dpkg-deb -x, for want of the rights to install"
  for deb in "${debs[@]}"; do dpkg-deb -x "$deb" "$view"; done
  "$source_dir/test/consumer/use.sh" "$source_dir" "$view/usr" "$build_dir/consumer" "$cmake" \
    "$cxx" ""
elif ((status != 0)); then
  fail "the installed packages don't work"
fi
echo "deb: right"
