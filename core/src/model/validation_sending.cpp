// SPDX-License-Identifier: Apache-2.0
#include "cortex/core/sending_checks.hpp"
#include "cortex/core/system_findings.hpp"
#include "cortex/core/type_description.hpp"

#include <algorithm>
#include <cstdint>
#include <mutex>
#include <set>
#include <string>
#include <utility>
#include <vector>

namespace cortex {
namespace {

struct Told {
    const SimplexTree& tree;
    const Structure& structure;
    Report& report;
};

// Octets in one datagram, that others take in one sample and of one agent's values
// (docs/protocol.md).
constexpr std::uint64_t mostInDatagram = 64'000, mostSent = std::uint64_t{16} << 20U,
                        mostRead = std::uint64_t{256} << 20U;

std::string megabytes(std::uint64_t octets) {
    constexpr std::uint64_t million = 1'000'000;
    return std::to_string((octets + million - 1) / million) + " MB";
}

std::uint64_t octetsOf(const BlockSizes& sizes) {
    return (std::uint64_t{sizes.ints} + sizes.floats) * 8 + sizes.bools + sizes.strings;
}

std::uint64_t octetsOf(const std::vector<DescribedItem>& items) {
    std::uint64_t octets = 0;
    for (const DescribedItem& item : items) {
        octets += item.name.size() + item.description.size();
        for (const auto& attribute : item.attributes) {
            octets += attribute.name.size() + attribute.text.size();
        }
    }
    return octets;
}

std::uint64_t octetsOf(const TypeDescription& type) {
    std::uint64_t octets = octetsOf(type.data);
    for (const DescribedCommand& each : type.commands) {
        octets += octetsOf(each.request) + octetsOf(each.response);
    }
    return octets;
}

void checkTypesInUse(const Told& told) {
    std::set<std::string> used;
    for (const SimplexInfo& info : told.structure.simplexes) used.insert(info.layout->type->name);
    const std::vector<std::string> names{used.begin(), used.end()};
    std::vector<TypeDescription> described;
    for (const Type* type : closureOf(told.tree.types(), names)) {
        described.push_back(describe(*type));
    }
    told.report.append(checkDescribed(told.tree.types(), described));
}

// The agent asks for all of them in one message.
void checkRemotePaths(const Told& told) {
    constexpr std::uint64_t besideEach = 8;
    std::uint64_t octets = 0, paths = 0;
    for (const SimplexInfo& info : told.structure.simplexes) {
        if (!info.remote) continue;
        ++paths;
        octets += info.path.size() + besideEach;
    }
    if (octets <= mostInDatagram) return;
    told.report.error("", finding::dataSize, told.tree.description().place,
                      "reads " + std::to_string(paths) +
                          " simplexes of other agents, whose paths take " + std::to_string(octets) +
                          " octets: at most 64000 can be asked for",
                      "use shorter paths, or divide the system among agents");
}

// Warnings, as an agent that nobody else reads may have all of it.
void checkValues(const Told& told) {
    std::uint64_t own = 0, all = 0;
    for (const SimplexInfo& info : told.structure.simplexes) {
        const std::uint64_t octets = octetsOf(info.layout->cyclic);
        all += octets;
        if (info.remote) continue;
        own += octets;
        const std::uint64_t constants = octetsOf(info.layout->constant);
        if (constants <= mostSent) continue;
        told.report.warning(info.path, finding::dataSize, told.tree.find(info.path)->place(),
                            "its constants can take " + megabytes(constants) +
                                ": at most 16 MiB can be sent, so no other agent and no tool "
                                "gets to know this one",
                            "shorten arrays and strings, or divide the type");
    }
    const Place& place = told.tree.description().place;
    if (own > mostSent) {
        told.report.warning("", finding::dataSize, place,
                            "the values of all simplexes can take " + megabytes(own) +
                                ": at most 16 MiB can be sent at once, so a tool that asks for "
                                "all of them gets none",
                            "shorten arrays and strings, or divide the system among agents");
    }
    if (all > mostRead) {
        told.report.warning("", finding::dataSize, place,
                            "the values of all simplexes can take " + megabytes(all) +
                                ": other agents and tools read no agent with more than 256 MiB",
                            "shorten arrays and strings, or divide the system among agents");
    }
}

}  // namespace

Report checkDescribed(const TypeModel& types, std::span<const TypeDescription> described) {
    static std::mutex mutex;
    static std::set<TypeHash> right;
    {
        const std::lock_guard lock{mutex};
        const auto isRight = [](const TypeDescription& each) { return right.contains(each.hash); };
        if (std::ranges::all_of(described, isRight)) return {};
    }
    const auto place = [&](const std::string& name) {
        const Type* type = types.find(name);
        return type == nullptr ? Place{} : type->place;
    };
    Report report, found;
    for (const TypeDescription& each : described) {
        const std::uint64_t octets = octetsOf(each);
        if (octets <= mostSent) continue;
        report.error(each.name, finding::modelSize, place(each.name),
                     "its attributes take " + megabytes(octets) +
                         " as text: other agents get at most 16 MiB of a type",
                     "shorten defaults, labels and descriptions, or divide the type");
    }
    modelOf(described, found);
    for (Finding& each : found.findings) {
        if (each.severity != Severity::Error) continue;
        each.place = place(each.path);
        each.message = "other agents could not read this type: " + each.message;
        report.add(std::move(each));
    }
    const std::lock_guard lock{mutex};
    if (report.ok()) {
        for (const TypeDescription& each : described) right.insert(each.hash);
    }
    return report;
}

Report checkSending(const SimplexTree& tree, const Structure& structure) {
    Report report;
    const Told told{tree, structure, report};
    checkTypesInUse(told);
    checkRemotePaths(told);
    checkValues(told);
    return report;
}

}  // namespace cortex
