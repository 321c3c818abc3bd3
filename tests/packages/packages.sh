#!/usr/bin/env bash
# SPDX-License-Identifier: Apache-2.0
# Installs the packages in a clean Debian 12, flies the kite there, builds a foreign program, and purges everything: what is left afterwards was there before.
#
# usage: packages.sh FOLDER_OF_PACKAGES CLEAN_ROOT.tar        the archive is made when it is missing
set -euo pipefail
packages=$(realpath "$1")
archive=$2
source=$(dirname "$(realpath "$0")")/../..

step() { printf '%4d s  %s\n' "$SECONDS" "$*"; }
fail() { echo "packages: $*" >&2; exit 1; }

if [ ! -e "$archive" ]; then
    step "making a clean system"
    mmdebstrap --quiet --variant=apt --include=ca-certificates bookworm "$archive.new.tar" /etc/apt/sources.list.d/debian.sources
    mv "$archive.new.tar" "$archive"
fi

root=$(mktemp --directory)
finish() {
    umount "$root/proc" "$root/dev" 2> /dev/null || true
    rm -rf --one-file-system "$root"
}
trap finish EXIT
step "unpacking the clean system"
tar --extract --file "$archive" --directory "$root"
cp /etc/resolv.conf "$root/etc/resolv.conf"
mount -t proc proc "$root/proc"
mount --bind /dev "$root/dev"
# Nothing that is installed may start a service here.
printf '#!/bin/sh\nexit 101\n' > "$root/usr/sbin/policy-rc.d"
chmod 755 "$root/usr/sbin/policy-rc.d"
inside() { chroot "$root" env -i PATH=/usr/sbin:/usr/bin:/sbin:/bin HOME=/root LC_ALL=C.UTF-8 DEBIAN_FRONTEND=noninteractive "$@"; }
apt() { inside apt-get --quiet=2 -o Dpkg::Use-Pty=0 --yes --no-install-recommends "$@" > "$root/tmp/apt.log" 2>&1 || { cat "$root/tmp/apt.log" >&2; fail "apt-get $* failed"; }; }
# All files of the system but what the kernel, apt, dpkg and adduser (copies of its last state) keep about themselves; and all users and groups.
inventory() {
    (cd "$root" && find . -xdev \( -path ./proc -o -path ./dev -o -path ./tmp -o -path ./var/cache -o -path ./var/lib/apt -o -path ./var/lib/dpkg -o -path ./var/log -o -path ./root -o -path ./run -o -path "./etc/*shadow-" -o -path "./etc/passwd-" -o -path "./etc/group-" \) -prune -o -print | sort)
    cut -d: -f1 "$root/etc/passwd" | sed 's/^/user /'
    cut -d: -f1 "$root/etc/group" | sed 's/^/group /'
}

apt update
apt upgrade
mkdir "$root/tmp/packages"
cp "$packages"/*.deb "$root/tmp/packages"
# What the packages need is there before, so that only they make a difference.
needed=$(for package in "$packages"/*.deb; do dpkg-deb --field "$package" Depends; echo; done | tr ',' '\n' | sed 's/|.*//; s/(.*//; s/ //g' | grep -v '^$' | grep -v qtplc | sort -u)
step "installing what the packages need"
# shellcheck disable=SC2086
apt install $needed cmake g++ make
inventory > "$root/tmp/before"

step "apt install ./*.deb"
(cd "$root" && apt install $(find tmp/packages -name '*.deb' | sed 's|^|/|'))
inventory > "$root/tmp/installed"
[ "$(wc -l < "$root/tmp/installed")" -gt "$(wc -l < "$root/tmp/before")" ] || fail "the packages bring nothing"
inside dpkg --verify $(cd "$packages" && for package in *.deb; do echo "${package%%_*}"; done) || fail "files are not as they were packed"
inside id qtplc > /dev/null || fail "there is no user qtplc"

step "awe_sil"
inside awe_sil --lockstep --duration 30 --report /tmp/flight.json > /dev/null || fail "awe_sil fails"
inside awe_sil --lockstep --duration 30 --processes > /dev/null || fail "awe_sil --processes fails"
inside qtplc --version
if inside test -x /usr/bin/awe_control_center; then
    inside env QT_QPA_PLATFORM=offscreen awe_control_center --version
fi

step "a foreign program"
mkdir "$root/tmp/winch"
cp -r "$source"/tests/consumer/winch "$root/tmp"
inside cmake -S /tmp/winch -B /tmp/winch/build > "$root/tmp/cmake.log" || fail "find_package(QtPlc) fails: $(cat "$root/tmp/cmake.log")"
inside cmake --build /tmp/winch/build > "$root/tmp/cmake.log" || fail "the program does not build: $(cat "$root/tmp/cmake.log")"
inside /tmp/winch/build/winch --help | grep -q -- --master || fail "the program does not run"
[ ! -e "$root/usr/include/QtPlc/QPlcHardwareNode.h" ] || inside qtplc_hardware --drivers > /dev/null || fail "qtplc_hardware fails"

step "apt purge"
# A service has made these by now.
install --directory "$root/var/lib/qtplc" "$root/etc/qtplc"
echo key > "$root/etc/qtplc/keys.ini"
apt purge $(cd "$packages" && for package in *.deb; do echo "${package%%_*}"; done)
inventory > "$root/tmp/after"
diff "$root/tmp/before" "$root/tmp/after" || fail "apt purge leaves (>) or takes (<) what is listed above"
step "the packages are installed, used and gone without a trace"
