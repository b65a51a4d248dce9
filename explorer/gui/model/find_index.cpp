// SPDX-License-Identifier: Apache-2.0
#include "model/find_index.hpp"

#include <QStringList>
#include <algorithm>
#include <cctype>
#include <limits>
#include <tuple>
#include <utility>

namespace cortex::gui {

namespace {

std::string lowered(std::string text) {
    std::ranges::transform(text, text.begin(), [](unsigned char each) {
        return static_cast<char>(std::tolower(each));
    });
    return text;
}

// How well a word fits, less is better; none: it does not.
constexpr int none = std::numeric_limits<int>::max();

int rank(const std::string& word, const std::string& lower, const std::string& last,
         const std::string& type) {
    if (last == word || lower == word) return 0;
    if (last.starts_with(word) || last.find(' ' + word) != std::string::npos) return 1;
    const std::size_t at = lower.find(word);
    if (at != std::string::npos) {
        if (last.find(word) != std::string::npos) return 2;
        return at > 0 && (lower[at - 1] == '/' || lower[at - 1] == '.') ? 3 : 4;
    }
    return type.find(word) != std::string::npos ? 5 : none;
}

}  // namespace

std::string Found::text() const {
    switch (kind) {
        case FoundKind::View:
        case FoundKind::Action:
            return name;
        case FoundKind::Simplex:
            return path;
        case FoundKind::Command:
            return path + " " + name;
        case FoundKind::Item:
            return path + "." + name;
    }
    return {};
}

FindIndex::FindIndex(const Frame& frame) {
    for (std::uint32_t agent = 0; agent < frame.agents.size(); ++agent) {
        const auto& structure = frame.agents[agent].structure;
        if (!structure) continue;
        for (std::uint32_t i = 0; i < structure->simplexes.size(); ++i) {
            const SimplexInfo& info = structure->simplexes[i];
            if (info.remote || frame.find(info.path) != Place{agent, i}) continue;
            const Type& type = *info.layout->type;
            add({FoundKind::Simplex, info.path, {}, type.name});
            for (const DataItem& each : type.data) {
                add({FoundKind::Item, info.path, each.name, type.name});
            }
            for (const Command& each : type.commands) {
                add({FoundKind::Command, info.path, each.name, type.name});
            }
        }
    }
}

void FindIndex::add(Found found) {
    std::string lower = lowered(found.text());
    std::string last = lowered(found.name);
    if (last.empty()) last = lower.substr(lower.rfind('/') + 1);
    all_.push_back({std::move(found), std::move(lower), std::move(last)});
}

std::vector<const Found*> FindIndex::find(const QString& words, std::size_t most) const {
    std::vector<std::string> wanted;
    for (const QString& each : words.split(' ', Qt::SkipEmptyParts)) {
        wanted.push_back(lowered(each.toStdString()));
    }
    if (wanted.empty()) return {};
    using Hit = std::tuple<bool, int, FoundKind, std::size_t, std::size_t>;  // ends with the index
    std::vector<Hit> hits;
    for (std::size_t i = 0; i < all_.size(); ++i) {
        const Entry& each = all_[i];
        const std::string type = lowered(each.found.type);
        int sum = 0;
        for (const std::string& word : wanted) {
            const int fit = rank(word, each.lower, each.last, type);
            sum = fit == none || sum == none ? none : sum + fit;
        }
        if (sum != none)
            hits.emplace_back(each.found.discards, sum, each.found.kind, each.lower.size(), i);
    }
    const auto end = hits.begin() + static_cast<std::ptrdiff_t>(std::min(most, hits.size()));
    std::ranges::partial_sort(hits, end);
    std::vector<const Found*> found;
    for (auto hit = hits.begin(); hit != end; ++hit) {
        found.push_back(&all_[std::get<4>(*hit)].found);
    }
    return found;
}

}  // namespace cortex::gui
