// SPDX-License-Identifier: Apache-2.0
#include "peers/owners.hpp"

#include "cortex/core/error.hpp"
#include "cortex/core/path.hpp"

#include "security/security_documents.hpp"
#include "wire/presence_extras.hpp"

#include <algorithm>
#include <cstdlib>
#include <limits>
#include <set>
#include <sstream>

namespace cortex::comms {
namespace {

constexpr std::size_t mostPairs = 8, longestPairs = 1'200, longestRoots = 1'000;
constexpr std::int64_t muchEarlier = 50'000'000;  // ns
constexpr std::string_view anyRoot = "*";

// The options of `create-agent` that give the same rights but for what is owned.
std::string otherRights(const AgentRights& rights) {
    std::string options;
    if (rights.mayCommand.empty()) options += " --read-only";
    if (!rights.mayCommand.empty() && rights.mayCommand != std::vector<std::string>{"/"}) {
        options += " --may-command";
        for (const std::string& each : rights.mayCommand) options += " " + each;
    }
    for (const int each : rights.domains) options += " --domain " + std::to_string(each);
    return options;
}

std::vector<std::string_view> wordsOf(std::string_view text) {
    std::vector<std::string_view> words;
    while (!text.empty()) {
        const std::size_t end = std::min(text.find(' '), text.size());
        if (end > 0) words.push_back(text.substr(0, end));
        text.remove_prefix(std::min(end + 1, text.size()));
    }
    return words;
}

bool isNear(std::string_view one, std::string_view other) {
    return isAtOrBelow(one, other) || isAtOrBelow(other, one);
}

// For a listener that ran for long when the later one came. 1: `one` was first, -1: `other` was.
int byEars(const Seniority& one, const Seniority& other, std::int64_t began) {
    if (one.heard == 0 || other.heard == 0 || one.heard == other.heard) return 0;
    if (std::max(one.heard, other.heard) - began < longAlone) return 0;
    return one.heard < other.heard ? 1 : -1;
}

bool saysItself(const Claimant& one, const Claimant& other) {
    return one.seniority.saysFirst(one.agent, other.agent);
}

std::string joined(std::span<const Claimant> claimants, const auto& with) {
    std::string text;
    for (const Claimant& each : claimants) {
        if (!with(each)) continue;
        text += (text.empty() ? "" : ", ") + each.agent;
    }
    return text;
}

}  // namespace

std::string textOf(const AgentPairs& pairs) {
    std::string text;
    for (std::size_t i = 0; i < std::min(pairs.size(), mostPairs); ++i) {
        text += (i == 0 ? "" : " ") + pairs[i].first + ">" + pairs[i].second;
    }
    return text;
}

AgentPairs pairsFrom(std::string_view text) {
    AgentPairs pairs;
    if (text.size() > longestPairs) return pairs;
    for (const std::string_view word : wordsOf(text)) {
        const std::size_t sign = word.find('>');
        if (sign == 0 || sign >= word.size() - 1 || pairs.size() >= mostPairs) continue;
        pairs.emplace_back(word.substr(0, sign), word.substr(sign + 1));
    }
    return pairs;
}

std::string rootsOf(const Structure& structure) {
    std::set<std::string_view> own;
    for (const SimplexInfo& info : structure.simplexes) {
        if (!info.remote) own.insert(info.path);
    }
    std::string text;
    for (const std::string_view path : own) {
        if (own.contains(path.substr(0, path.rfind('/')))) continue;
        text += (text.empty() ? "" : " ") + std::string{path};
        if (text.size() > longestRoots) return std::string{anyRoot};
    }
    return text;
}

bool mayHave(std::string_view roots, std::string_view path) {
    if (roots.empty() || roots == anyRoot) return true;
    return std::ranges::any_of(wordsOf(roots),
                               [&](std::string_view each) { return isAtOrBelow(path, each); });
}

bool mayShare(std::string_view some, std::string_view others) {
    if (some.empty() || some == anyRoot || others.empty() || others == anyRoot) return true;
    const auto theirs = wordsOf(others);
    return std::ranges::any_of(wordsOf(some), [&](std::string_view each) {
        return std::ranges::any_of(theirs,
                                   [&](std::string_view their) { return isNear(each, their); });
    });
}

Rank rankOf(std::string_view agent, std::string_view path, bool secured,
            const AgentRights* rights) {
    if (isAtOrBelow(path, "/" + std::string{agent})) return Rank::Named;
    if (!secured) return Rank::Equal;
    if (rights == nullptr) return Rank::Least;
    if (!rights->owns.empty()) return ownsPath(*rights, path) ? Rank::Owns : Rank::None;
    return rights->mayCommand.empty() ? Rank::Least : Rank::Equal;
}

void requireOwned(const Structure& structure, const AgentRights& rights) {
    if (rights.owns.empty()) return;
    std::string owned, missing, all;
    std::size_t lacks = 0;
    for (const std::string& each : rights.owns) {
        owned += (owned.empty() ? "" : ", ") + each;
        all += " " + each;
    }
    for (const SimplexInfo& info : structure.simplexes) {
        const bool covered = info.remote || ownsPath(rights, info.path) ||
                             isAtOrBelow(info.path, "/" + rights.agent);
        const std::uint32_t parent = structure.find(info.path.substr(0, info.path.rfind('/')));
        if (covered || (parent != noSimplex && !structure.simplexes[parent].remote)) continue;
        ++lacks;
        missing += (missing.empty() ? "" : ", ") + info.path;
        all += " " + info.path;
    }
    if (missing.empty()) return;
    throw Error("the security folder of " + rights.agent + " owns " + owned + "; " + missing +
                (lacks == 1 ? " is" : " are") + " not below it: cortex security create-agent " +
                rights.agent + " --owns" + all + otherRights(rights) + " --out " + rights.agent +
                "-new");
}

bool Seniority::take(const Presence& presence, std::int64_t now) {
    const std::int64_t start = now - timeIn(presence, uptimeOfAgent);
    const AgentPairs said = pairsFrom(textIn(presence, firstOfPairs));
    const bool changed = heard == 0 || said != says || start < began - muchEarlier;
    began = heard == 0 ? start : std::min(began, start);
    if (heard == 0) heard = now;
    says = said;
    return changed;
}

bool Seniority::saysFirst(std::string_view one, std::string_view other) const {
    return std::ranges::any_of(
        says, [&](const AgentPair& each) { return each.first == one && each.second == other; });
}

bool wasFirst(const Claimant& one, const Claimant& other, std::int64_t began) {
    const bool againstOne = one.seniority.saysFirst(other.agent, one.agent);
    const bool againstOther = other.seniority.saysFirst(one.agent, other.agent);
    if (againstOne != againstOther) return againstOther;
    if (againstOne) return other.agent < one.agent;  // the word of the smaller name counts
    const int ears = byEars(one.seniority, other.seniority, began);
    if (ears != 0) return ears > 0;
    const std::int64_t longer = other.seniority.began - one.seniority.began;
    if (std::abs(longer) > nearlyAtOnce) return longer > 0;
    return one.agent < other.agent;
}

// In a circle, the smallest name.
std::optional<std::size_t> ownerAmong(std::span<const Claimant> claimants,
                                      const WasFirst& wasFirst) {
    const auto standing = [](const Claimant& each) { return std::pair{!each.lost, each.rank}; };
    std::vector<std::size_t> best;
    for (std::size_t i = 0; i < claimants.size(); ++i) {
        if (claimants[i].rank == Rank::None) continue;
        if (!best.empty() && standing(claimants[best.front()]) < standing(claimants[i])) {
            best.clear();
        }
        if (best.empty() || standing(claimants[best.front()]) == standing(claimants[i])) {
            best.push_back(i);
        }
    }
    if (best.empty()) return {};
    const auto isFirst = [&](std::size_t one) {
        return std::ranges::none_of(best, [&](std::size_t other) {
            return other != one && wasFirst(claimants[other], claimants[one]);
        });
    };
    const auto first = std::ranges::find_if(best, isFirst);
    if (first != best.end()) return *first;
    return *std::ranges::min_element(best, {},
                                     [&](std::size_t each) { return claimants[each].agent; });
}

std::string ownerReason(std::span<const Claimant> claimants, std::size_t place,
                        std::int64_t began) {
    const Claimant& owner = claimants[place];
    std::vector<Claimant> rivals;
    for (std::size_t i = 0; i < claimants.size(); ++i) {
        if (i != place) rivals.push_back(claimants[i]);
    }
    const auto equal = [&](const Claimant& each) { return each.rank == owner.rank; };
    if (std::ranges::none_of(rivals, equal)) {
        if (owner.rank == Rank::Named) return "which has that name";
        if (owner.rank == Rank::Owns) return "which has the right to it (--owns)";
        const std::string others = joined(rivals, [](const Claimant&) { return true; });
        return "as " + others +
               (owner.rank == Rank::Equal ? " may only look" : " owns other paths");
    }
    const auto disputes = [&](const Claimant& each) {
        return equal(each) && saysItself(each, owner);
    };
    const bool isHeardFirst = std::ranges::all_of(rivals, [&](const Claimant& each) {
        return !equal(each) || each.seniority.saysFirst(owner.agent, each.agent) ||
               saysItself(owner, each) || byEars(owner.seniority, each.seniority, began) > 0;
    });
    const bool runsLonger = std::ranges::all_of(rivals, [&](const Claimant& each) {
        return !equal(each) || each.seniority.began - owner.seniority.began > nearlyAtOnce;
    });
    if (const std::string who = joined(rivals, disputes); !who.empty()) {
        return (runsLonger ? "which runs longer; " : "which was heard first here; ") + who +
               " says that it was first: stop one of them";
    }
    if (isHeardFirst) return "which was there first";
    return runsLonger ? "which runs longer" : "whose name comes first";
}

std::string ownerText(std::string_view path, std::span<const Claimant> claimants,
                      std::int64_t began) {
    const auto owner = ownerAmong(claimants, [&](const Claimant& one, const Claimant& other) {
        return wasFirst(one, other, began);
    });
    const std::string all = joined(claimants, [](const Claimant&) { return true; });
    const bool single = claimants.size() == 1;
    if (!owner) {
        return (single ? "agent " + all + " has " : "agents " + all + " both have ") +
               std::string{path} + "; commands go to nobody, as " +
               (single ? "its signed list owns other paths" : "none owns it (--owns)");
    }
    return "agents " + all + " both have " + std::string{path} + "; commands go to " +
           claimants[*owner].agent + ", " + ownerReason(claimants, *owner, began);
}

}  // namespace cortex::comms
