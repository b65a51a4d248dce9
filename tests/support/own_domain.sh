# SPDX-License-Identifier: Apache-2.0
# Sourced by tests: ownDomain is a domain of DDS, 1 to 99, that nobody uses: no port of it is bound,
# and no other test has locked its file, as this one does until it ends. See own_domain.hpp.
ownDomain=
for ((offset = 0; offset < 99; ++offset)); do
    ownDomain=$((1 + ($$ + offset) % 99))
    [[ -e /tmp/cortex-test-domain-$ownDomain ]] || : >"/tmp/cortex-test-domain-$ownDomain"
    exec {ownDomainLock}<"/tmp/cortex-test-domain-$ownDomain"
    # Ends with 0 where a UDP port of the domain is bound.
    if flock --nonblock "$ownDomainLock" &&
        ! awk -v first=$((7400 + 250 * ownDomain)) '
            BEGIN { last = first + 249 }
            NR > 1 {
                split($2, local, ":")
                port = 0
                for (i = 1; i <= 4; ++i)
                    port = 16 * port + index("123456789ABCDEF", substr(local[2], i, 1))
                if (port >= first && port <= last) found = 1
            }
            END { exit !found }' /proc/net/udp; then
        break
    fi
    exec {ownDomainLock}<&-
    ownDomain=
done
[[ $ownDomain ]] || {
    echo 'error: every domain of DDS from 1 to 99 is used' >&2
    exit 1
}
