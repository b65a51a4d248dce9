// SPDX-License-Identifier: Apache-2.0
#pragma once

#include "dds/participant.hpp"
#include "wire/messages.hpp"

#include <cstdint>
#include <memory>
#include <string>
#include <vector>

// What others may do on a network of CorteX agents, made with Fast DDS itself.
namespace cortex::comms {

// A participant that writes any octets under the name of a type, keyed unless said otherwise.
class RawWriter {
public:
    RawWriter(const NetworkOptions& options, const Topic& topic, const std::string& typeName,
              bool keyed = true);
    ~RawWriter();

    bool write(const Id& key, const std::vector<std::uint8_t>& octets);
    std::uint32_t readers() const;

private:
    struct Impl;
    std::unique_ptr<Impl> impl_;
};

// A discovery server with the identity 0 at 127.0.0.1.
class DiscoveryServer {
public:
    explicit DiscoveryServer(const NetworkOptions& options);
    ~DiscoveryServer();

    std::string address() const;

private:
    struct Impl;
    std::unique_ptr<Impl> impl_;
};

// Every other UDP port from `first` on, as far as it was free.
class TakenPorts {
public:
    TakenPorts(int first, int count);
    ~TakenPorts();

private:
    std::vector<int> descriptors_;
};

}  // namespace cortex::comms
