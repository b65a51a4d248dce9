// SPDX-License-Identifier: Apache-2.0
#pragma once

#include "cortex/core/agreement.hpp"
#include "cortex/core/type_description.hpp"

#include "comms/told_agent.hpp"
#include "wire/cdr.hpp"
#include "wire/ids.hpp"
#include "wire/type_messages.hpp"

#include <algorithm>
#include <cstddef>
#include <cstdint>
#include <cstdlib>
#include <map>
#include <span>
#include <string>
#include <vector>

namespace cortex::fuzz {

using Octets = std::vector<std::uint8_t>;

// What an agent tells, changed as an input says: the first octet chooses what is made to agree
// again afterwards, so that lies get past the first checks; then follow changes of single octets
// (sample, offset, value) and whole payloads instead of a sample (0x80 | sample, length, octets).
class ToldScript {
public:
    ToldScript() {
        for (const comms::Model& model : told_.models) payloads_.push_back(encoded(model));
        payloads_.push_back(encoded(told_.presence));
        payloads_.push_back(encoded(told_.block(1)));
        payloads_.push_back(encoded(told_.block(2)));
        payloads_.push_back(encoded(told_.summary()));
    }

    struct Told {
        std::vector<comms::Model> models;
        std::vector<comms::Presence> presences;
        std::vector<comms::Block> blocks;
        std::vector<comms::Summary> summaries;
    };
    Told play(std::span<const std::uint8_t> input) const {
        const std::uint8_t agreeing = take(input);
        std::vector<Octets> payloads = payloads_;
        while (!input.empty()) change(payloads, input);
        Told told;
        std::size_t each = 0;
        for (; each < told_.models.size(); ++each) add(payloads[each], told.models);
        add(payloads[each++], told.presences);
        for (; each + 1 < payloads.size(); ++each) add(payloads[each], told.blocks);
        add(payloads[each], told.summaries);
        if ((agreeing & 1U) != 0) agreeModels(told);
        if ((agreeing & 8U) != 0) agreeHashes(told);
        if ((agreeing & 2U) != 0) agreePresences(told);
        if ((agreeing & 4U) != 0) agreeBlocks(told);
        return told;
    }
    const comms::ToldAgent& agent() const { return told_; }

private:
    template <class Message>
    static Octets encoded(const Message& message) {
        Octets payload(comms::encodedSize(message));
        if (comms::encode(message, payload) != payload.size()) std::abort();
        return payload;
    }
    template <class Message>
    static void add(const Octets& payload, std::vector<Message>& to) {
        Message message;
        if (comms::decode(payload, message)) to.push_back(std::move(message));
    }
    static std::uint8_t take(std::span<const std::uint8_t>& input) {
        if (input.empty()) return 0;
        const std::uint8_t octet = input.front();
        input = input.subspan(1);
        return octet;
    }
    static void change(std::vector<Octets>& payloads, std::span<const std::uint8_t>& input) {
        const std::uint8_t which = take(input);
        const std::size_t low = take(input);
        const std::size_t number = low | std::size_t{take(input)} << 8U;
        Octets& payload = payloads[(which & 0x7fU) % payloads.size()];
        if ((which & 0x80U) != 0) {
            const auto octets = input.first(std::min(number, input.size()));
            payload.assign(octets.begin(), octets.end());
            input = input.subspan(octets.size());
        } else if (!payload.empty()) {
            payload[number % payload.size()] = take(input);
        }
    }
    void agreeModels(Told& told) const {
        for (comms::Model& model : told.models) {
            model.agent = told_.name();
            model.epoch = told_.epoch();
            model.id = comms::modelId(model);
        }
    }
    // With the hashes of what it says: a receiver must look at all of it.
    static void agreeHashes(Told& told) {
        const std::map<std::string, TypeHash> hashes = hashesOf(told.models);
        for (comms::Model& model : told.models) {
            for (auto& each : model.types) {
                if (hashes.contains(each.name)) each.hash = hashes.at(each.name);
            }
            for (auto& each : model.simplexes) {
                if (hashes.contains(each.type)) each.typeHash = hashes.at(each.type);
            }
        }
    }
    static std::map<std::string, TypeHash> hashesOf(const std::vector<comms::Model>& models) {
        std::vector<TypeDescription> types;
        for (const comms::Model& model : models) {
            for (const auto& each : model.types) types.push_back(comms::typeDescription(each));
        }
        std::map<std::string, TypeHash> hashes;
        Report report;
        const TypeModel made = modelOf(types, report);
        for (const auto& [name, type] : made.types()) hashes[name] = typeHash(type);
        for (const Finding& each : report.findings) {
            const std::size_t hex = each.message.rfind(", it is ");
            if (each.rule != "type-hash" || hex == std::string::npos) continue;
            TypeHash& hash = hashes[each.path];
            for (std::size_t i = 0; i < hash.size(); ++i) {
                const std::string octet = each.message.substr(hex + 8 + 2 * i, 2);
                hash[i] = static_cast<std::uint8_t>(std::stoi(octet, nullptr, 16));
            }
        }
        return hashes;
    }
    void agreePresences(Told& told) const {
        std::map<std::string, TypeHash> types;
        std::map<std::string, comms::SimplexMessage> simplexes;
        for (const comms::Model& model : told.models) {
            for (const auto& each : model.types) types[each.name] = each.hash;
            for (const auto& each : model.simplexes) simplexes[each.path] = each;
        }
        std::vector<comms::SimplexMessage> all;
        for (const auto& [path, simplex] : simplexes) all.push_back(simplex);
        for (comms::Presence& presence : told.presences) {
            presence.agent = comms::agentId(told_.name());
            presence.name = told_.name();
            presence.epoch = told_.epoch();
            presence.types = static_cast<std::uint32_t>(types.size());
            presence.simplexes = static_cast<std::uint32_t>(all.size());
            presence.typesHash = comms::typesHash(types);
            presence.structureHash = comms::structureHash(all);
        }
    }
    void agreeBlocks(Told& told) const {
        for (comms::Block& block : told.blocks) {
            block.agent = comms::agentId(told_.name());
            block.epoch = told_.epoch();
            if (!told.presences.empty()) block.structureHash = told.presences.front().structureHash;
        }
        for (comms::Summary& summary : told.summaries) {
            summary.agent = comms::agentId(told_.name());
            summary.epoch = told_.epoch();
            if (told.presences.empty()) continue;
            summary.structureHash = told.presences.front().structureHash;
        }
    }

    comms::ToldAgent told_;
    std::vector<Octets> payloads_;
};

}  // namespace cortex::fuzz
