// SPDX-License-Identifier: Apache-2.0
#pragma once

#include "dds/topics.hpp"
#include "wire/cdr.hpp"
#include "wire/messages.hpp"

#include <algorithm>
#include <cstdint>
#include <functional>
#include <span>

#include <fastdds/dds/topic/TopicDataType.hpp>

namespace cortex::comms {

// One sample as Fast DDS handles it: a message to be written, or the place for one that is read.
template <class M>
struct Envelope {
    const M* outgoing = nullptr;
    M incoming;
    bool wellFormed = false;  // of a message that was read; a malformed one must still be taken

    const M& message() const { return outgoing ? *outgoing : incoming; }
};

// Tells Fast DDS how a message is encoded and what its key is. It has no state and never throws.
// Any thread.
template <class M>
class TopicType final : public eprosima::fastdds::dds::TopicDataType {
    using Payload = eprosima::fastrtps::rtps::SerializedPayload_t;
    using Handle = eprosima::fastrtps::rtps::InstanceHandle_t;
    static constexpr std::uint32_t usualSize = 256;  // what a history reserves at first

public:
    TopicType() {
        setName(M::typeName);
        m_typeSize = usualSize;
        m_isGetKeyDefined = Keyed<M>;
        auto_fill_type_object(false);
        auto_fill_type_information(false);
    }

    bool serialize(void* data, Payload* payload) override {
        const auto& message = static_cast<const Envelope<M>*>(data)->message();
        const auto length = encode(message, std::span{payload->data, payload->max_size});
        payload->length = static_cast<std::uint32_t>(length);
        payload->encapsulation = CDR_LE;
        return length != 0;
    }

    // A malformed payload counts as success here. Otherwise Fast DDS would keep it and offer it
    // again.
    bool deserialize(Payload* payload, void* data) override {
        auto& envelope = *static_cast<Envelope<M>*>(data);
        const std::span<const std::uint8_t> octets{payload->data, payload->length};
        try {
            envelope.wellFormed = decode(octets, envelope.incoming);
        } catch (...) {
            envelope.wellFormed = false;
        }
        return true;
    }

    std::function<std::uint32_t()> getSerializedSizeProvider(void* data) override {
        return [data] {
            const auto& message = static_cast<const Envelope<M>*>(data)->message();
            return static_cast<std::uint32_t>(encodedSize(message));
        };
    }

    void* createData() override { return new Envelope<M>; }
    void deleteData(void* data) override { delete static_cast<Envelope<M>*>(data); }

    bool getKey(void* data, Handle* handle, bool) override {
        if constexpr (Keyed<M>) {
            const Id& key = static_cast<const Envelope<M>*>(data)->message().key();
            for (std::size_t i = 0; i < key.size(); ++i) handle->value[i] = key[i];
        }
        return Keyed<M>;
    }
};

}  // namespace cortex::comms
