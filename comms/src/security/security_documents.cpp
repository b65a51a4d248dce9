// SPDX-License-Identifier: Apache-2.0
#include "security/security_documents.hpp"

#include "cortex/comms/network_options.hpp"
#include "cortex/core/path.hpp"

#include <algorithm>
#include <array>
#include <charconv>

namespace cortex::comms {
namespace {

constexpr std::time_t day = 86'400;

std::string domainsOf(const AgentRights& rights) {
    if (rights.domains.empty()) {
        return "<id_range><min>0</min><max>" + std::to_string(lastDomain) + "</max></id_range>";
    }
    std::string text;
    for (const int each : rights.domains) text += "<id>" + std::to_string(each) + "</id>";
    return text;
}

// Takes "name: value" from the beginning of a text. False: the text begins with another name.
bool takeField(std::string_view& text, std::string_view name, std::string& value) {
    if (!text.starts_with(name) || !text.substr(name.size()).starts_with(": ")) return false;
    text.remove_prefix(name.size() + 2);
    const std::size_t end = text.find('\n');
    if (end == std::string_view::npos) return false;
    std::string_view line = text.substr(0, end);
    if (line.ends_with('\r')) line.remove_suffix(1);
    value = line;
    text.remove_prefix(end + 1);
    return true;
}

// The same for a name that only a later version knows.
bool skipField(std::string_view& text) {
    const std::string_view line = text.substr(0, text.find('\n'));
    const std::string name{line.substr(0, line.find(": "))};
    std::string ignored;
    return !name.empty() && takeField(text, name, ignored);
}

std::optional<int> domainFrom(const std::string& text) {
    int domain = -1;
    const auto [end, error] = std::from_chars(text.data(), text.data() + text.size(), domain);
    if (error != std::errc{} || end != text.data() + text.size()) return {};
    return domain;
}

}  // namespace

std::string governance() {
    return R"(<?xml version="1.0" encoding="UTF-8"?>
<dds>
  <domain_access_rules>
    <domain_rule>
      <domains><id_range><min>0</min><max>)" +
           std::to_string(lastDomain) + R"(</max></id_range></domains>
      <allow_unauthenticated_participants>false</allow_unauthenticated_participants>
      <enable_join_access_control>true</enable_join_access_control>
      <discovery_protection_kind>ENCRYPT</discovery_protection_kind>
      <liveliness_protection_kind>ENCRYPT</liveliness_protection_kind>
      <rtps_protection_kind>SIGN</rtps_protection_kind>
      <topic_access_rules>
        <topic_rule>
          <topic_expression>*</topic_expression>
          <enable_discovery_protection>true</enable_discovery_protection>
          <enable_liveliness_protection>true</enable_liveliness_protection>
          <enable_read_access_control>true</enable_read_access_control>
          <enable_write_access_control>true</enable_write_access_control>
          <metadata_protection_kind>ENCRYPT</metadata_protection_kind>
          <data_protection_kind>NONE</data_protection_kind>
        </topic_rule>
      </topic_access_rules>
    </domain_rule>
  </domain_access_rules>
</dds>
)";
}

// All topics of CorteX are allowed for everybody: the receiver decides who may command what, so
// that it can answer and report. The dates allow one more day, because those of the certificate
// count.
std::string permissions(const AgentRights& rights) {
    const std::string from = utcText(std::time(nullptr) - day).substr(0, 19);
    const std::string until = utcText(utcFrom(rights.until).value_or(0) + day).substr(0, 19);
    return R"(<?xml version="1.0" encoding="UTF-8"?>
<dds>
  <permissions>
    <grant name=")" +
           rights.agent + R"(">
      <subject_name>CN=)" +
           rights.agent + R"(,O=CorteX</subject_name>
      <validity><not_before>)" +
           from + "</not_before><not_after>" + until + R"(</not_after></validity>
      <allow_rule>
        <domains>)" +
           domainsOf(rights) + R"(</domains>
        <publish><topics><topic>cortex/*</topic></topics></publish>
        <subscribe><topics><topic>cortex/*</topic></topics></subscribe>
      </allow_rule>
      <default>DENY</default>
    </grant>
  </permissions>
</dds>
)";
}

std::string textOf(const CommandList& list) {
    std::string text = "CorteX commands: 1\nagent: " + list.rights.agent + "\nkey: " + list.key +
                       "\nuntil: " + list.rights.until + "\n";
    for (const int each : list.rights.domains) text += "domain: " + std::to_string(each) + "\n";
    for (const std::string& each : list.rights.mayCommand) text += "may-command: " + each + "\n";
    for (const std::string& each : list.rights.owns) text += "owns: " + each + "\n";
    for (const std::string& each : list.rights.carriedBy) text += "carried-by: " + each + "\n";
    return text;
}

std::optional<CommandList> commandListFrom(std::string_view text) {
    std::string version;
    if (!takeField(text, "CorteX commands", version) || version != "1") return {};
    CommandList list;
    AgentRights& rights = list.rights;
    rights.mayCommand.clear();
    const bool begins = takeField(text, "agent", rights.agent) &&
                        takeField(text, "key", list.key) && takeField(text, "until", rights.until);
    if (!begins) return {};
    std::string value;
    while (!text.empty()) {
        if (takeField(text, "domain", value)) {
            const auto domain = domainFrom(value);
            if (!domain) return {};
            rights.domains.push_back(*domain);
        } else if (takeField(text, "may-command", value)) {
            rights.mayCommand.push_back(value);
        } else if (takeField(text, "owns", value)) {
            rights.owns.push_back(value);
        } else if (takeField(text, "carried-by", value)) {
            rights.carriedBy.push_back(value);
        } else if (!skipField(text)) {
            return {};
        }
    }
    if (!utcFrom(rights.until)) return {};
    return list;
}

std::string utcText(std::time_t time) {
    std::tm fields{};
    gmtime_r(&time, &fields);
    std::array<char, 32> text{};
    std::strftime(text.data(), text.size(), "%Y-%m-%dT%H:%M:%SZ", &fields);
    return text.data();
}

std::optional<std::time_t> utcFrom(const std::string& text) {
    std::tm fields{};
    const char* end = strptime(text.c_str(), "%Y-%m-%dT%H:%M:%SZ", &fields);
    if (end == nullptr || *end != '\0') return {};
    return timegm(&fields);
}

bool ownsPath(const AgentRights& rights, std::string_view path) {
    return std::ranges::any_of(rights.owns, [&](const std::string& each) {
        return !each.empty() && isAtOrBelow(path, each);
    });
}

bool mayCommand(const AgentRights& rights, std::string_view path, std::string& why) {
    std::string ends;
    for (const std::string& each : rights.mayCommand) {
        if (!each.empty() && isAtOrBelow(path, each)) return true;
        ends += (ends.empty() ? "" : ", ") + each;
    }
    why = ends.empty() ? "it may only look" : "its authority ends at " + ends;
    return false;
}

}  // namespace cortex::comms
