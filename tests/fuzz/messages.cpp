// SPDX-License-Identifier: Apache-2.0
#include "wire/cdr.hpp"

#include <cstdlib>
#include <vector>

namespace {

using namespace cortex::comms;
using Payload = std::span<const std::uint8_t>;

template <class Message>
std::vector<std::uint8_t> encoded(const Message& message) {
    std::vector<std::uint8_t> payload(encodedSize(message));
    if (encode(message, payload) != payload.size()) std::abort();
    return payload;
}

// Octets are compared, not messages: a NaN is a value too.
template <class Message>
void readAndWrite(Payload payload) {
    Message message, again;
    if (!decode(payload, message)) return;
    const std::vector<std::uint8_t> written = encoded(message);
    if (written.size() > payload.size() || written.size() + 3 < payload.size()) std::abort();
    if (!decode(Payload{written}, again) || encoded(again) != written) std::abort();
}

constexpr void (*kinds[])(Payload) = {
    readAndWrite<Presence>,    readAndWrite<Model>,    readAndWrite<Block>,
    readAndWrite<Command>,     readAndWrite<Answer>,   readAndWrite<EventMessage>,
    readAndWrite<PastMessage>, readAndWrite<Interest>, readAndWrite<Summary>};

}  // namespace

// The first octet chooses what the others are.
extern "C" int LLVMFuzzerTestOneInput(const std::uint8_t* data, std::size_t size) {
    if (size > 0) kinds[data[0] % std::size(kinds)](Payload{data + 1, size - 1});
    return 0;
}
