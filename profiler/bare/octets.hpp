// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <array>
#include <cstdint>
#include <cstring>
#include <functional>
#include <vector>

#include <fastdds/dds/topic/TopicDataType.hpp>

namespace cortex::profiler {

// The type of a topic of bare Fast DDS: a sequence of octets.
class Octets final : public eprosima::fastdds::dds::TopicDataType {
    using Payload = eprosima::fastrtps::rtps::SerializedPayload_t;

public:
    using Data = std::vector<std::uint8_t>;
    static constexpr std::uint32_t largest = 65000;

    Octets() {
        setName("Octets");
        m_typeSize = largest + 8;
        m_isGetKeyDefined = false;
    }
    bool serialize(void* data, Payload* payload) override {
        const Data& octets = *static_cast<Data*>(data);
        constexpr std::array<std::uint8_t, 4> littleEndian{0, 1, 0, 0};
        const auto size = static_cast<std::uint32_t>(octets.size());
        std::memcpy(payload->data, littleEndian.data(), 4);
        std::memcpy(payload->data + 4, &size, 4);
        std::memcpy(payload->data + 8, octets.data(), size);
        payload->length = size + 8;
        return true;
    }
    bool deserialize(Payload* payload, void* data) override {
        if (payload->length < 8) return false;
        std::uint32_t size = 0;
        std::memcpy(&size, payload->data + 4, 4);
        if (size > payload->length - 8) return false;
        static_cast<Data*>(data)->assign(payload->data + 8, payload->data + 8 + size);
        return true;
    }
    std::function<std::uint32_t()> getSerializedSizeProvider(void* data) override {
        return [data] { return static_cast<std::uint32_t>(static_cast<Data*>(data)->size() + 8); };
    }
    void* createData() override { return new Data; }
    void deleteData(void* data) override { delete static_cast<Data*>(data); }
    bool getKey(void*, eprosima::fastrtps::rtps::InstanceHandle_t*, bool) override { return false; }
};

}  // namespace cortex::profiler
