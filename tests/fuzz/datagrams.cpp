// SPDX-License-Identifier: Apache-2.0
#include "rtps/datagram_filter.hpp"

#include <cstdlib>
#include <vector>

namespace {

using namespace cortex::comms::rtps;

// One filter sees all inputs, as it sees all datagrams of a process.
DatagramFilter& filter() {
    static DatagramFilter one{Prefix{1}};
    return one;
}

std::uint64_t malformed() {
    return filter().dropped(Refusal::Framing) + filter().dropped(Refusal::Content) +
           filter().dropped(Refusal::Parameters);
}

}  // namespace

// What is left of a datagram is well formed.
extern "C" int LLVMFuzzerTestOneInput(const std::uint8_t* data, std::size_t size) {
    static std::int64_t now = 1;
    now += 1'000'000;
    std::vector<std::uint8_t> datagram{data, data + size};
    const std::size_t left = filter().admit(datagram, 0x7f000001, now).left;
    if (left > size) std::abort();
    if (left == 0) return 0;
    datagram.resize(left);
    const std::uint64_t before = malformed();
    filter().admit(datagram, 0x7f000001, now);
    if (malformed() != before) std::abort();
    filter().noteSent(datagram, now);
    return 0;
}
