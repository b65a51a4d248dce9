#!/usr/bin/env bash
# SPDX-License-Identifier: Apache-2.0
# The Debian packages in a bare root: installed by apt, started, removed. The arguments are the
# folder with the packages and a folder for the root and a picture. Needs root.
set -euo pipefail
debs=$(realpath "$1")
work=$(realpath "$2")
root=$work/root

# Packages come from where this machine has its own from.
rm -rf "$root"
shopt -s nullglob
sources=()
for file in /etc/apt/sources.list /etc/apt/sources.list.d/*.{list,sources}; do
    [[ -s $file ]] && sources+=("$file")
done
apt-config dump | grep -E '^Acquire::(Check|Retries|https?::Proxy)' >"$work/apt.conf" || true
suite=$(. /etc/os-release && echo "$VERSION_CODENAME")
echo "a bare root of Debian ($suite)"
mmdebstrap --quiet --variant=apt --aptopt="$work/apt.conf" "$suite" "$root" "${sources[@]}"

# Mounts and processes of these are gone with the last command.
inside() { unshare --mount --pid --fork --kill-child "${@:2}" bash -c "$1" bare "$root"; }
prepare='set -euo pipefail
mount -t proc proc "$1/proc"; mount --rbind /dev "$1/dev"
run() { LC_ALL=C.UTF-8 HOME=/root DEBIAN_FRONTEND=noninteractive chroot "$1" "${@:2}"; }
'

echo 'only the package for Modbus needs libmodbus, and only the one for physics MuJoCo'
for library in modbus mujoco; do
    for deb in "$debs"/*.deb; do
        [[ $(dpkg-deb -f "$deb" Depends) != *lib$library* ]] || dpkg-deb -f "$deb" Package
    done >"$work/need"
    [[ $(<"$work/need") == "cortex-$library" ]] || { cat "$work/need"; exit 1; }
done

echo 'installed with what they depend on'
mkdir "$root/debs"
cp "$debs"/*.deb "$root/debs"
(cd "$root" && find . -xdev ! -path './debs/*' -name '*cortex*') >"$work/before"
inside "$prepare"'
    run "$1" apt-get update -qq
    run "$1" apt-get install -qqy -o Dpkg::Use-Pty=0 --no-install-recommends $(cd "$1"; ls ./debs/*.deb |
        sed "s:^\.::") >"$1/tmp/install.log" 2>&1 || { cat "$1/tmp/install.log"; exit 1; }'

echo 'each program and verb has its page'
verbs=$(chroot "$root" cortex --help | sed -n '/^Subcommands:/,/^$/s/^  \([a-z-]*\) .*/cortex-\1/p')
for page in cortex{,-agent,-ds402-sim,-gripper-sim,-explorer} $verbs; do
    [[ -f $root/usr/share/man/man1/$page.1.gz ]] || { echo "error: no page $page.1"; exit 1; }
done

echo 'an agent, seen by the command line and in a picture of the window'
# /run is in memory, as on every Debian: the agent is killed at the end and leaves files there.
inside "ip link set lo up; $prepare mount -t tmpfs run \"\$1/run\";"'
    examples=/usr/share/cortex/examples
    run "$1" cortex-agent $examples/lbr_teleop/operator.xml --interface lo --log /tmp/agent.log &
    run "$1" cortex list --interface lo --timeout 10
    run "$1" cortex-explorer --interface lo --view system --timeout 20 --screenshot /tmp/picture.png' \
    --net
head -c 8 "$root/tmp/picture.png" | grep -q PNG
cp "$root/tmp/picture.png" "$work/picture.png"

echo 'an agent names the package of a plug-in that is not there'
# PACKAGE TYPE: removes the package and runs a system with the type.
removed='removed() {
    run "$1" apt-get remove -qqy "$2" >"$1/tmp/remove.log" 2>&1
    cat >"$1/tmp/plant.xml" <<END
<system name="plant">
  <morphology file="cortex-morphology.xml"/>
  <cluster name="plant" frequency="100"/>
  <simplex path="/one" type="$3"/>
</system>
END
    run "$1" cortex-agent /tmp/plant.xml --offline >"$1/tmp/plant.log" 2>&1 &&
        { echo "error: $3 ran without $2"; exit 1; }
    grep "says that $3 is in it; install package $2" "$1/tmp/plant.log"
}
'
inside "$prepare$removed"'
    removed "$1" cortex-modbus ModbusIoDevice
    removed "$1" cortex-mujoco MujocoWorld'

echo 'removed without a trace'
inside "$prepare"'run "$1" apt-get purge -qqy "libcortex*" "cortex-*" >"$1/tmp/purge.log" 2>&1'
(cd "$root" && find . -xdev ! -path './debs/*' -name '*cortex*') >"$work/after"
diff "$work/before" "$work/after"
rm -rf "$root"
