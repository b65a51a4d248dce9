#!/usr/bin/env bash
# SPDX-License-Identifier: Apache-2.0
# The examples, built outside of the tree against an installed cortex, by CMake and by pkg-config.
# The argument is the folder that cortex is installed in.
set -euo pipefail
cd "$(dirname "${BASH_SOURCE[0]}")/.."
source tests/support/own_domain.sh
prefix=$(realpath "$1")
outside=$(mktemp -d)
trap 'rm -rf "$outside"' EXIT

# NAME: copies an example and builds it.
built() {
    cp -r "examples/$1" "$outside/$1"
    cmake -S "$outside/$1" -B "$outside/$1/build" -G Ninja -DCMAKE_PREFIX_PATH="$prefix" >/dev/null
    cmake --build "$outside/$1/build"
}

built e01_two_simplexes
(cd "$outside" && e01_two_simplexes/build/e01_two_simplexes | tail -3)

echo 'the example of two agents: the follower follows'
built e02_two_agents
agent=$outside/e02_two_agents/build/e02_two_agents
export CORTEX_DOMAIN=$ownDomain CORTEX_INTERFACE=lo
timeout 60 "$agent" mover >/dev/null & mover=$!
timeout 60 "$agent" follower >"$outside/follower" & follower=$!
until awk '$1 != 0 {moved = 1} END {exit !moved}' "$outside/follower"; do
    kill -0 "$follower"  # it runs still
    sleep 0.1
done
kill "$mover" "$follower"
wait || true
tail -3 "$outside/follower"

echo 'the example of three agents: both start, and when one ends the other is stopped'
built e03_supervisor
agent=$outside/e03_supervisor/build/e03_supervisor
PATH=$prefix/bin:$PATH
stateOf() { cortex show "$1" --timeout 2 2>/dev/null | grep -m1 -w state || true; }
# STATE PATH: waits until the simplex is in that state.
becomes() {
    local end=$((SECONDS + 60))
    while ((SECONDS < end)); do
        [[ $(stateOf "$2") == *"$1"* ]] && return
        sleep 0.1
    done
    echo "error: $2 does not become $1: $(stateOf "$2")" >&2
    return 1
}
"$agent" left & left=$!
"$agent" right & right=$!
"$agent" supervisor & supervisor=$!
becomes Active /left/sine
becomes Active /right/sine
kill "$left"
becomes Standby /right/sine
kill "$right" "$supervisor"
wait "$left" "$right" "$supervisor"

echo 'the example of a device: its plug-in talks to the simulated oven'
built e04_device
"$outside/e04_device/build/simulated_oven" "$outside/oven" &
oven=$!
"$prefix/bin/cortex-agent" "$outside/e04_device/oven.xml" --offline --startup --seconds 1 \
    --plugin "$outside/e04_device/build/oven.so" --set "/oven.address=$outside/oven" \
    >"$outside/bakery" 2>&1
kill "$oven"
grep 'all active simplexes are started' "$outside/bakery"

echo 'only its plug-in needs libmodbus, or MuJoCo, and the agent finds both'
needs() { [[ $(readelf -d "$1") == *NEEDED*lib"$2"* ]]; }
for library in modbus mujoco; do
    for file in "$prefix"/lib/libcortex*.so "$prefix"/bin/cortex-agent "$prefix"/bin/cortex; do
        if needs "$file" "$library"; then echo "error: $file needs lib$library" >&2; exit 1; fi
    done
    needs "$prefix/lib/cortex/agent/cortex-$library.so" "$library"
done
cat >"$outside/coupler.xml" <<'END'
<system name="coupler">
  <morphology file="devices-morphology.xml"/>
  <cluster name="hall" frequency="100"/>
  <simplex path="/lamps" type="DigitalOutputGroup"/>
  <simplex path="/coupler" type="ModbusIoDevice">
    <relate rule="digitalOutputs" to="/lamps"/>
    <set data="address" value="127.0.0.1:1"/>
    <set data="coilsAt" value="0"/>
  </simplex>
</system>
END
"$prefix/bin/cortex-agent" "$outside/coupler.xml" --offline --seconds 0.1 --log /dev/null 2>&1 |
    grep "plug-in $prefix/lib/cortex/agent/cortex-modbus.so: loaded for ModbusIoDevice"
cat >"$outside/world.xml" <<'END'
<system name="cell">
  <morphology file="physics-morphology.xml"/>
  <cluster name="cell" frequency="1000"/>
  <simplex path="/arm" type="SerialManipulator">
    <relate rule="axes" to="/arm/axis"/>
    <relate rule="demands" to="/arm/demand"/>
  </simplex>
  <simplex path="/arm/axis" type="KukaLbrAxis1"/>
  <simplex path="/arm/demand" type="KukaLbrAxis1"/>
  <simplex path="/hold" type="HoldAxisController">
    <relate rule="axes" to="/arm/axis"/>
    <relate rule="demands" to="/arm/demand"/>
  </simplex>
  <simplex path="/world" type="MujocoWorld">
    <relate rule="manipulators" to="/arm"/>
    <relate rule="observations" to="/arm/axis"/>
    <relate rule="demands" to="/arm/demand"/>
  </simplex>
</system>
END
"$prefix/bin/cortex-agent" "$outside/world.xml" --offline --startup --seconds 1 --priority 0 \
    --log /dev/null >"$outside/world.said" 2>&1
grep "plug-in $prefix/lib/cortex/agent/cortex-mujoco.so: loaded for MujocoWorld" \
    "$outside/world.said"
grep 'all active simplexes are started' "$outside/world.said"

echo 'its model is a file of its own'
"$prefix/bin/cortex-agent" "$outside/world.xml" --dump-mjcf >"$outside/world.mjcf" 2>/dev/null
[[ $(head -c 7 "$outside/world.mjcf") == '<mujoco' ]]
tail -1 "$outside/world.mjcf" | grep '^</mujoco>$'

echo 'the examples of XML alone run as they are installed'
for plant in gantry jog_axis lbr_teleop; do
    "$prefix/bin/cortex-agent" "$prefix/share/cortex/examples/$plant/$plant.xml" --offline \
        --startup --seconds 1 --priority 0 --log /dev/null 2>&1 |
        grep 'all active simplexes are started'
done

echo 'the hooks of a plug-in are checked'
built water
"$prefix/bin/cortex-agent" "$outside/water/water.xml" --offline --startup --seconds 2 --check-hooks \
    --plugin "$outside/water/build/water.so" --log /dev/null | grep 'hook check: no violation'

echo 'the example of a view: the window loads it, and names what it cannot load'
built e05_own_view
mkdir "$outside/broken"
touch "$outside/broken/broken.so"
for plugins in e05_own_view/build broken; do
    status=0
    CORTEX_EXPLORER_PLUGINS=$outside/$plugins "$prefix/bin/cortex-explorer" --timeout 0.1 \
        --screenshot "$outside/picture.png" 2>"$outside/$(basename "$plugins").said" || status=$?
    ((status == 3))  # nobody is heard
done
grep 'broken.so was not loaded' "$outside/broken.said"
if grep 'was not loaded' "$outside/build.said"; then exit 1; fi

echo 'the same with pkg-config'
export PKG_CONFIG_PATH=$prefix/lib/pkgconfig
g++ -std=c++20 "$outside"/e01_two_simplexes/*.cpp -o "$outside/e01" \
    $(pkg-config --cflags --libs cortex)
(cd "$outside" && LD_LIBRARY_PATH=$prefix/lib ./e01 | tail -1)

echo 'every installed header can be included; those of the window need Qt'
(cd "$prefix/include" && find cortex -name '*.hpp' ! -path 'cortex/explorer/*') | sort |
    sed 's/.*/#include "&"/' >"$outside/headers.cpp"
g++ -std=c++20 -fsyntax-only "$outside/headers.cpp" $(pkg-config --cflags cortex eigen3)
