// SPDX-License-Identifier: Apache-2.0
#include "files/system_reader.hpp"

#include "cortex/core/xml_text.hpp"

#include "files/element_reader.hpp"

#include <algorithm>
#include <array>
#include <cmath>

#include <arpa/inet.h>

namespace cortex {

namespace {

using Child = ElementReader::Child;
using Relate = SystemDescription::Relate;
using Setting = SystemDescription::Setting;
using Entry = SystemDescription::SimplexEntry;
using Cluster = SystemDescription::ClusterEntry;

std::string readSeconds(double& target, std::string_view text) {
    const auto seconds = toFloat(text);
    if (!seconds || !std::isfinite(*seconds) || *seconds <= 0) return "a number of seconds above 0";
    target = *seconds;
    return {};
}

constexpr std::array relateAttributes{
    AttributeReader<Relate>{
        "rule", [](Relate& relate, std::string_view text) { return readText(relate.rule, text); },
        true},
    AttributeReader<Relate>{
        "to", [](Relate& relate, std::string_view text) { return readText(relate.to, text); },
        true},
    AttributeReader<Relate>{
        "delayed",
        [](Relate& relate, std::string_view text) { return readBool(relate.delayed, text); }},
    AttributeReader<Relate>{
        "remote",
        [](Relate& relate, std::string_view text) { return readBool(relate.remote, text); }},
    AttributeReader<Relate>{
        "type", [](Relate& relate, std::string_view text) { return readText(relate.type, text); }},
    AttributeReader<Relate>{
        "maxAge",
        [](Relate& relate, std::string_view text) { return readSeconds(relate.maxAge, text); }},
};

constexpr std::array settingAttributes{
    AttributeReader<Setting>{
        "data",
        [](Setting& setting, std::string_view text) { return readText(setting.data, text); }, true},
    AttributeReader<Setting>{
        "value",
        [](Setting& setting, std::string_view text) { return readText(setting.value, text); },
        true},
    AttributeReader<Setting>{
        "escaped",
        [](Setting& setting, std::string_view text) { return readBool(setting.escaped, text); }},
};

std::string readInteger(int& target, std::string_view text, int least) {
    constexpr int most = 1'000'000;
    const auto value = toInt(text);
    if (!value || *value < least || *value > most) {
        return "a whole number from " + std::to_string(least) + " to " + std::to_string(most);
    }
    target = static_cast<int>(*value);
    return {};
}

constexpr std::array simplexAttributes{
    AttributeReader<Entry>{
        "path", [](Entry& entry, std::string_view text) { return readText(entry.path, text); },
        true},
    AttributeReader<Entry>{
        "type", [](Entry& entry, std::string_view text) { return readText(entry.type, text); },
        true},
    AttributeReader<Entry>{
        "every",
        [](Entry& entry, std::string_view text) { return readInteger(entry.every, text, 1); }},
    AttributeReader<Entry>{
        "phase",
        [](Entry& entry, std::string_view text) { return readInteger(entry.phase, text, 0); }},
};

// Attributes of <cluster>: their forms only, meaning and ranges belong to who uses them.
struct ClusterAttribute {
    const char* name;
    bool (*valid)(std::string_view text);
    const char* expected;
};

bool anyText(std::string_view) { return true; }
bool frequency(std::string_view text) {
    const double hertz = toFloat(text).value_or(0);
    return hertz >= 0.01 && hertz <= 1e5;
}
bool positive(std::string_view text) { return toFloat(text).value_or(0) > 0; }
bool notNegative(std::string_view text) { return toFloat(text).value_or(-1) >= 0; }
template <std::int64_t Least, std::int64_t Most>
bool between(std::string_view text) {
    const auto number = toInt(text);
    return number && *number >= Least && *number <= Most;
}
constexpr auto count = between<0, 1'000'000>;
bool truth(std::string_view text) { return toBool(text).has_value(); }
bool overflow(std::string_view text) {
    return text == "skip" || text == "catchUp" || text == "halt";
}
bool control(std::string_view text) { return text == "open" || text == "required"; }
bool trigger(std::string_view text) { return text == "clock" || text == "external"; }
// "fd:3", "udp:5005", "udp:127.0.0.1:5005"
bool triggerFrom(std::string_view text) {
    const std::size_t last = text.rfind(':');
    const std::size_t first = text.find(':');
    if (last == std::string_view::npos) return false;
    const std::string_view number = text.substr(last + 1);
    if (text.substr(0, first) == "fd") return first == last && count(number);
    if (text.substr(0, first) != "udp" || !between<1, 65'535>(number)) return false;
    const std::string address{first == last ? "0.0.0.0" : text.substr(first + 1, last - first - 1)};
    in_addr parsed{};
    return inet_pton(AF_INET, address.c_str(), &parsed) == 1;
}
bool counts(std::string_view text) {
    const auto words = splitBlanks(text);
    return !words.empty() && std::ranges::all_of(words, count);
}

constexpr std::array clusterAttributes{
    ClusterAttribute{"name", anyText, ""},
    ClusterAttribute{"frequency", frequency, "a number of Hz from 0.01 to 100000"},
    ClusterAttribute{"trigger", trigger, "clock or external"},
    ClusterAttribute{"triggerFrom", triggerFrom,
                     "udp:PORT, udp:ADDRESS:PORT with an IPv4 address, or fd:N"},
    ClusterAttribute{"threads", between<1, 256>, "a whole number from 1 to 256"},
    ClusterAttribute{"priority", between<0, 99>, "a whole number from 0, for none, to 99"},
    ClusterAttribute{"cpus", counts, "CPU numbers separated by blanks"},
    ClusterAttribute{"acrossCaches", truth, "true or false"},
    ClusterAttribute{"lockMemory", truth, "true or false"},
    ClusterAttribute{"keepCpusAwake", truth, "true or false"},
    ClusterAttribute{"overflow", overflow, "skip, catchUp or halt"},
    ClusterAttribute{"catchUpCycles", count, "a whole number from 0 to 1000000"},
    ClusterAttribute{"warnDuty", notNegative, "a number of % from 0"},
    ClusterAttribute{"warnLateness", notNegative, "a number of % from 0"},
    ClusterAttribute{"haltLateness", notNegative, "a number of % from 0"},
    ClusterAttribute{"watchdogPeriods", positive, "a number greater than 0"},
    ClusterAttribute{"triggerTimeout", positive, "a number of seconds greater than 0"},
    ClusterAttribute{"stopTimeout", positive, "a number of seconds greater than 0"},
    ClusterAttribute{"control", control, "open or required"},
    ClusterAttribute{"imageReaders", count, "a whole number from 0 to 1000000"},
};

template <int Index>
std::string keep(Cluster& cluster, std::string_view text) {
    constexpr const ClusterAttribute& attribute = clusterAttributes[Index];
    if (!attribute.valid(text)) return attribute.expected;
    if constexpr (Index == 0) {
        cluster.name = text;
    } else {
        cluster.attributes.emplace(attribute.name, text);
    }
    return {};
}

template <int... Indices>
constexpr auto clusterReaders(std::integer_sequence<int, Indices...>) {
    return std::array{
        AttributeReader<Cluster>{clusterAttributes[Indices].name, keep<Indices>, Indices == 0}...};
}

void readSetting(const ElementReader& reader, const XmlElement& child, Entry& entry,
                 std::map<std::string, Place>& known) {
    Setting setting;
    setting.place = reader.place(child.line);
    const bool complete = reader.attributes(
        child, std::span<const AttributeReader<Setting>>{settingAttributes}, setting);
    reader.children(child, {});
    if (!complete) return;
    if (setting.escaped) {
        const auto value = withoutEscapes(setting.value);
        if (!value) {
            return reader.error(finding::attributeValue, child.line,
                                "<set> is escaped, and has value=" + inQuotes(setting.value),
                                "write \\\\ for a \\, and \\x with two digits for an octet");
        }
        setting.value = *value;
    }
    const auto [same, added] = known.emplace(setting.data, setting.place);
    if (!added) {
        reader.error(finding::duplicateSetting, child.line,
                     inQuotes(setting.data) + " is set twice, first at " + same->second.text(),
                     "keep one <set data=\"" + setting.data + "\" …/>");
        return;
    }
    entry.settings.push_back(std::move(setting));
}

void readRelate(const ElementReader& reader, const XmlElement& child, Entry& entry) {
    Relate relate;
    relate.place = reader.place(child.line);
    const bool complete = reader.attributes(
        child, std::span<const AttributeReader<Relate>>{relateAttributes}, relate);
    reader.children(child, {});
    if (complete) entry.relates.push_back(std::move(relate));
}

// What the attributes of <cluster> mean together.
void checkTrigger(const ElementReader& reader, const XmlElement& element, const Cluster& cluster) {
    const auto stated = cluster.attributes.find("trigger");
    const bool isExternal = stated != cluster.attributes.end() && stated->second == "external";
    if (!isExternal) {
        if (cluster.attributes.contains("triggerFrom")) {
            reader.error(finding::attributeValue, element.line,
                         "triggerFrom has no effect on a loop that runs by the clock",
                         "write trigger=\"external\", or leave triggerFrom out");
        }
        return;
    }
    constexpr std::array needed{
        std::pair{"triggerFrom", "where its ticks come from: triggerFrom=\"udp:5005\" or \"fd:3\""},
        std::pair{"frequency", "how often its ticks come: frequency=\"1000\""}};
    for (const auto& [name, meaning] : needed) {
        if (element.find(name) != nullptr) continue;
        reader.error(finding::missingAttribute, element.line,
                     std::string{"trigger=\"external\" needs "} + name,
                     std::string{"write "} + meaning);
    }
}

}  // namespace

void readCluster(const XmlElement& element, const std::string& file, SystemDescription& system,
                 std::map<std::string, Place>& paths, Report& report) {
    const XmlAttribute* name = element.find("name");
    const ElementReader reader{file, report, name ? "/" + name->value : ""};
    constexpr auto attributes = clusterReaders(
        std::make_integer_sequence<int, static_cast<int>(clusterAttributes.size())>{});
    Cluster cluster;
    cluster.place = reader.place(element.line);
    const bool complete =
        reader.attributes(element, std::span<const AttributeReader<Cluster>>{attributes}, cluster);
    reader.children(element, {});
    checkTrigger(reader, element, cluster);
    if (!complete) return;
    const auto [same, added] = paths.emplace("cluster " + cluster.name, cluster.place);
    if (!added) {
        reader.error(finding::duplicateCluster, element.line,
                     "cluster " + inQuotes(cluster.name) + " is given twice, first at " +
                         same->second.text(),
                     "keep one of them");
        return;
    }
    system.clusters.push_back(std::move(cluster));
}

void readSimplex(const XmlElement& element, const std::string& file, SystemDescription& system,
                 std::map<std::string, Place>& paths, Report& report) {
    const XmlAttribute* path = element.find("path");
    const ElementReader reader{file, report, path ? path->value : ""};
    Entry entry;
    entry.place = reader.place(element.line);
    const bool complete = reader.attributes(
        element, std::span<const AttributeReader<Entry>>{simplexAttributes}, entry);
    std::map<std::string, Place> known;
    const Child children[] = {
        {"relate", [&](const XmlElement& child) { readRelate(reader, child, entry); }},
        {"set", [&](const XmlElement& child) { readSetting(reader, child, entry, known); }}};
    reader.children(element, children);
    if (entry.phase >= entry.every) {
        reader.error(finding::phaseRange, element.line,
                     "phase " + std::to_string(entry.phase) +
                         " is not below every=" + std::to_string(entry.every),
                     "write a phase from 0 to " + std::to_string(entry.every - 1));
        entry.phase = -1;
    }
    if (!complete) return;
    const auto [same, added] = paths.emplace(entry.path, entry.place);
    if (!added) {
        reader.error(finding::duplicatePath, element.line,
                     "the path is given twice, first at " + same->second.text(),
                     "give this simplex another path, or merge both into one element");
        return;
    }
    system.simplexes.push_back(std::move(entry));
}

}  // namespace cortex
