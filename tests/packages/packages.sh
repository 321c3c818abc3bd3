#!/usr/bin/env bash
# SPDX-License-Identifier: Apache-2.0
# Installs the packages in a clean Debian 12, flies the kite there, builds a foreign program, and
# purges everything: what is left afterwards was there before.
#
# usage: packages.sh FOLDER_OF_PACKAGES CLEAN_ROOT.tar        the archive is made when it is missing
set -euo pipefail
packages=$(realpath "$1")
archive=$2
source=$(dirname "$(realpath "$0")")/../..

. "$source/scripts/lib/progress"
fail() { echo "packages: $*" >&2; exit 1; }

if [ ! -e "$archive" ]; then
    step "Make a clean system" mmdebstrap --verbose --variant=apt --include=ca-certificates \
        bookworm "$archive.new.tar" /etc/apt/sources.list.d/debian.sources
    mv "$archive.new.tar" "$archive"
fi

root=$(mktemp --directory)
finish() {
    umount "$root/proc" "$root/dev" 2> /dev/null || true
    rm -rf --one-file-system "$root"
}
trap finish EXIT
step "Unpack the clean system" tar --extract --verbose --file "$archive" --directory "$root"
cp /etc/resolv.conf "$root/etc/resolv.conf"
mount -t proc proc "$root/proc"
mount --bind /dev "$root/dev"
# Nothing that is installed may start a service here.
printf '#!/bin/sh\nexit 101\n' > "$root/usr/sbin/policy-rc.d"
chmod 755 "$root/usr/sbin/policy-rc.d"
inside() {
    chroot "$root" env -i PATH=/usr/sbin:/usr/bin:/sbin:/bin HOME=/root LC_ALL=C.UTF-8 \
        DEBIAN_FRONTEND=noninteractive "$@"
}
# apt TITLE COMMAND [PACKAGE...]
apt() {
    local title=$1
    shift
    step "$title" inside "${apt_get[@]}" --yes --no-install-recommends "$@" || fail "apt-get $* failed"
}
# All files of the system but what the kernel, apt, dpkg and adduser (copies of its last state) keep
# about themselves; and all users and groups.
inventory() {
    (cd "$root" && find . -xdev \( -path ./proc -o -path ./dev -o -path ./tmp \
        -o -path ./var/cache -o -path ./var/lib/apt -o -path ./var/lib/dpkg -o -path ./var/log \
        -o -path ./root -o -path ./run -o -path "./etc/*shadow-" -o -path "./etc/passwd-" \
        -o -path "./etc/group-" \) -prune -o -print | sort)
    cut -d: -f1 "$root/etc/passwd" | sed 's/^/user /'
    cut -d: -f1 "$root/etc/group" | sed 's/^/group /'
}

apt "Read the lists of packages" update
apt "Upgrade the clean system" upgrade
mkdir "$root/tmp/packages"
cp "$packages"/*.deb "$root/tmp/packages"
# What the packages need is there before, so that only they make a difference.
needed=$(for package in "$packages"/*.deb; do dpkg-deb --field "$package" Depends; echo; done | tr ',' '\n' \
    | sed 's/|.*//; s/(.*//; s/ //g' | grep -v '^$' | grep -v qtplc | sort -u)
# shellcheck disable=SC2086
apt "Install what the packages need" install $needed cmake g++ make
inventory > "$root/tmp/before"

(cd "$root" && apt "Install the packages" install $(find tmp/packages -name '*.deb' | sed 's|^|/|'))
inventory > "$root/tmp/installed"
[ "$(wc -l < "$root/tmp/installed")" -gt "$(wc -l < "$root/tmp/before")" ] || fail "the packages bring nothing"
inside dpkg --verify $(cd "$packages" && for package in *.deb; do echo "${package%%_*}"; done) \
    || fail "files are not as they were packed"
inside id qtplc > /dev/null || fail "there is no user qtplc"

step "Fly" inside awe_sil --lockstep --duration 30 --report /tmp/flight.json || fail "awe_sil fails"
step "Fly in three processes" inside awe_sil --lockstep --duration 30 --processes || fail "awe_sil --processes fails"
inside qtplc --version
if inside test -x /usr/bin/awe_control_center; then
    inside env QT_QPA_PLATFORM=offscreen awe_control_center --version
fi

# Each package alone: what its documents link to is in it.
documented=0
for package in "$packages"/*.deb; do
    alone=$(mktemp --directory)
    dpkg-deb --extract "$package" "$alone"
    if [ -n "$(find "$alone" -name '*.md')" ]; then
        documented=$((documented + 1))
        python3 -B "$source/tests/documents/documents.py" --installed "$alone" \
            || fail "links in ${package##*/} lead nowhere"
    fi
    rm -rf "$alone"
done
[ "$documented" -gt 0 ] || fail "no package has the documents"
for unit in "$root"/lib/systemd/system/qtplc-* "$root"/usr/lib/systemd/system/qtplc-*; do
    [ ! -e "$unit" ] || sed -n 's/^Documentation=file://p' "$unit" | while read -r page; do
        [ -e "$root$page" ] || fail "${unit##*/} names $page, which no package brings"
    done
done

mkdir "$root/tmp/winch"
cp -r "$source"/tests/consumer/winch "$root/tmp"
step "Configure a program that uses the packages" inside cmake -S /tmp/winch -B /tmp/winch/build \
    || fail "find_package(QtPlc) fails"
step "Build it" inside cmake --build /tmp/winch/build || fail "the program does not build"
inside /tmp/winch/build/winch --help | grep -q -- --master || fail "the program does not run"
[ ! -e "$root/usr/include/QtPlc/QPlcHardwareNode.h" ] || inside qtplc_hardware --drivers > /dev/null \
    || fail "qtplc_hardware fails"
[ ! -e "$root/usr/include/QtPlc/QPlcFmuNode.h" ] || inside qtplc_fmu node --help > /dev/null || fail "qtplc_fmu fails"

# A service has made these by now.
install --directory "$root/var/lib/qtplc" "$root/var/log/qtplc" "$root/etc/qtplc"
echo key > "$root/etc/qtplc/keys.ini"
apt "Purge the packages" purge $(cd "$packages" && for package in *.deb; do echo "${package%%_*}"; done)
inventory > "$root/tmp/after"
diff "$root/tmp/before" "$root/tmp/after" || fail "apt purge leaves (>) or takes (<) what is listed above"
echo "the packages are installed, used and gone without a trace"
