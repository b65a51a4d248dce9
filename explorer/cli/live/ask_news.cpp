// SPDX-License-Identifier: Apache-2.0
#include "live/ask_news.hpp"

#include "common/leases_text.hpp"
#include "common/person_name.hpp"
#include "text/words.hpp"

#include <algorithm>

namespace cortex::cli {
namespace {

using Lease = comms::LeaseClient::Lease;

bool isSame(const Asked& one, const Asked& other) {
    return one.tool == other.tool && one.number == other.number;
}

bool isOneOf(const std::vector<Asked>& all, const Asked& asked) {
    return std::ranges::any_of(all, [&](const Asked& each) { return isSame(each, asked); });
}

bool isHeld(const std::vector<Lease>& held, const Asked& asked) {
    return std::ranges::any_of(asked.gives, [&](const Lease& gives) {
        return std::ranges::any_of(held, [&](const Lease& each) {
            return each.agent == gives.agent && each.prefix == gives.prefix;
        });
    });
}

std::string textOf(const Asked& asked, const std::vector<Asked>& all) {
    std::string name;
    name.append(1, ' ').append(wordFor(asked, all));
    return common::whoText(asked.tool, asked.person) + " asks for " + asked.prefix + "; 'grant" +
           name + "' hands over " + common::leasesText(asked.gives) + ", 'refuse" + name +
           "' refuses";
}

}  // namespace

bool isNameOfTool(const std::string& name) {
    const std::size_t at = name.rfind('@'), dot = name.rfind('.'), dash = name.rfind('-');
    const auto isMadeOf = [&](std::size_t begin, std::size_t end, const char* characters) {
        return begin < end && name.find_first_not_of(characters, begin) >= end;
    };
    return at != std::string::npos && dot != std::string::npos && dash != std::string::npos &&
           0 < at && at < dot && isMadeOf(dot + 1, dash, "0123456789") &&
           isMadeOf(dash + 1, name.size(), "0123456789abcdef");
}

std::string wordFor(const Asked& asked, const std::vector<Asked>& all) {
    const auto meant = meantBy(asked.person, all);
    const bool clear = meant.size() == 1 && meant.front().tool == asked.tool;
    const bool plain = common::shownName(asked.person) == asked.person;
    return asWord(clear && plain ? asked.person : asked.tool);
}

std::vector<Asked> meantBy(const std::string& name, const std::vector<Asked>& all) {
    std::vector<Asked> tools, people;
    for (const Asked& each : all) {
        if (each.tool == name) tools.push_back(each);
        if (each.person == name && !isNameOfTool(name)) people.push_back(each);
    }
    return tools.empty() ? people : tools;
}

// Of what we hold no longer it is we who know why.
std::vector<std::string> AskNews::news(const comms::LeaseClient& leases) {
    std::vector<std::string> news;
    const auto asked = leases.asked();
    const auto held = leases.held();
    std::erase_if(told_, [&](const Asked& each) {
        if (isOneOf(asked, each)) return false;
        if (isHeld(held, each)) {
            news.push_back(common::whoText(each.tool, each.person) + " no longer asks for " +
                           each.prefix);
        }
        return true;
    });
    for (const Asked& each : asked) {
        if (isOneOf(told_, each)) continue;
        news.push_back(textOf(each, asked));
        told_.push_back(each);
    }
    return news;
}

void AskNews::answered(const Asked& asked) {
    std::erase_if(told_, [&](const Asked& each) { return isSame(each, asked); });
}

}  // namespace cortex::cli
