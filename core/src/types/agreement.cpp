// SPDX-License-Identifier: Apache-2.0
#include "cortex/core/agreement.hpp"

#include "cortex/core/error.hpp"

#include "types/type_attributes.hpp"

#include <algorithm>
#include <array>
#include <map>
#include <string_view>
#include <utility>

#include <openssl/evp.h>

namespace cortex {

namespace {

constexpr std::string_view formNumber = "1";

void append(std::string& text, int level, const std::vector<TypeAttribute>& attributes) {
    for (const TypeAttribute& each : attributes) {
        if (!each.stated()) continue;
        text.append(static_cast<std::size_t>(level), ' ').append(each.name).append(" ");
        text.append(each.value).append("\n");
    }
}

void append(std::string& text, const char* list, const std::vector<DataItem>& parameters) {
    for (const DataItem& each : parameters) {
        text.append(" ").append(list).append(" ").append(each.name).append("\n");
        append(text, 2, attributesOf(each));
    }
}

// What differs between two agents in one attribute.
using IsContradiction = bool (*)(const TypeAttribute& ours, const TypeAttribute& theirs);

bool ofType(const TypeAttribute& ours, const TypeAttribute&) {
    return ours.name == "role" || ours.name == "extends";
}

bool ofData(const TypeAttribute& ours, const TypeAttribute& theirs) {
    constexpr std::array<std::string_view, 5> shape{"kind", "length", "capacity", "unit",
                                                    "constant"};
    if (std::ranges::find(shape, ours.name) != shape.end()) return true;
    return ours.name.starts_with("label ") && !ours.value.empty() && !theirs.value.empty();
}

bool never(const TypeAttribute&, const TypeAttribute&) { return false; }

// Collects the disagreements about one type.
class Comparison {
public:
    Comparison(const Type& ours, const Type& theirs) : ours_{ours}, theirs_{theirs} {}

    std::vector<Disagreement> run() {
        attributes("", "", attributesOf(ours_), attributesOf(theirs_), ofType);
        items(ours_.data, theirs_.data, "", true,
              [this](const std::string& item, const DataItem& ours, const DataItem& theirs) {
                  attributes(item, "", attributesOf(ours), attributesOf(theirs), ofData);
              });
        items(ours_.commands, theirs_.commands, "command ", true,
              [this](const std::string& item, const Command& ours, const Command& theirs) {
                  attributes(item, "", attributesOf(ours), attributesOf(theirs), never);
                  parameters(item, "request ", ours.request, theirs.request);
                  parameters(item, "response ", ours.response, theirs.response);
              });
        items(ours_.rules, theirs_.rules, "rule ", false,
              [this](const std::string& item, const Rule& ours, const Rule& theirs) {
                  attributes(item, "", attributesOf(ours), attributesOf(theirs), never);
              });
        return std::move(found_);
    }

private:
    void add(const std::string& item, std::string ours, std::string theirs, bool contradiction) {
        found_.push_back({ours_.name, item, std::move(ours), std::move(theirs), contradiction});
    }

    void attributes(const std::string& item, const std::string& prefix,
                    const std::vector<TypeAttribute>& ours,
                    const std::vector<TypeAttribute>& theirs, IsContradiction contradiction) {
        std::map<std::string, std::pair<TypeAttribute, TypeAttribute>> both;
        for (const TypeAttribute& each : ours) both[each.name].first = each;
        for (const TypeAttribute& each : theirs) both[each.name].second = each;
        const auto text = [&](const std::string& name, const TypeAttribute& each) {
            return each.value.empty() ? "" : prefix + name + "=" + each.value;
        };
        for (auto& [name, pair] : both) {
            if (pair.first.value == pair.second.value) continue;
            pair.first.name = name;
            add(item, text(name, pair.first), text(name, pair.second),
                contradiction(pair.first, pair.second));
        }
    }

    // Both lists are sorted by name.
    template <class Item, class Compare>
    void items(const std::vector<Item>& ours, const std::vector<Item>& theirs, const char* what,
               bool lackContradicts, Compare compare) {
        std::map<std::string_view, std::pair<const Item*, const Item*>> both;
        for (const Item& each : ours) both[each.name].first = &each;
        for (const Item& each : theirs) both[each.name].second = &each;
        for (const auto& [name, pair] : both) {
            const std::string item = what + std::string{name};
            if (pair.first && pair.second) {
                compare(item, *pair.first, *pair.second);
            } else {
                add(item, pair.first ? brief(*pair.first) : "",
                    pair.second ? brief(*pair.second) : "", lackContradicts);
            }
        }
    }

    // Parameters are a record: their names and order are its shape.
    void parameters(const std::string& item, const std::string& list,
                    const std::vector<DataItem>& ours, const std::vector<DataItem>& theirs) {
        const auto names = [](const std::vector<DataItem>& parameters) {
            std::string result;
            for (const DataItem& each : parameters) result += " " + each.name;
            return result;
        };
        if (names(ours) != names(theirs)) {
            add(item, list.substr(0, list.size() - 1) + names(ours),
                list.substr(0, list.size() - 1) + names(theirs), true);
            return;
        }
        for (std::size_t i = 0; i < ours.size(); ++i) {
            attributes(item, list + ours[i].name + ": ", attributesOf(ours[i]),
                       attributesOf(theirs[i]), ofData);
        }
    }

    template <class Item>
    static std::string brief(const Item& item) {
        std::string result;
        for (const TypeAttribute& each : attributesOf(item)) {
            if (!each.stated() && each.name != "kind") continue;
            result += (result.empty() ? "" : " ") + each.name + "=" + each.value;
        }
        return result.empty() ? item.name : result;
    }

    const Type& ours_;
    const Type& theirs_;
    std::vector<Disagreement> found_;
};

}  // namespace

std::string canonicalText(const Type& type) {
    std::string text{formNumber};
    text += "\ntype " + type.name + "\n";
    append(text, 1, attributesOf(type));
    for (const Command& each : type.commands) {
        text += "command " + each.name + "\n";
        append(text, 1, attributesOf(each));
        append(text, "request", each.request);
        append(text, "response", each.response);
    }
    for (const DataItem& each : type.data) {
        text += "data " + each.name + "\n";
        append(text, 1, attributesOf(each));
    }
    for (const Rule& each : type.rules) {
        text += "rule " + each.name + "\n";
        append(text, 1, attributesOf(each));
    }
    return text;
}

TypeHash typeHash(const Type& type) { return hashOf(canonicalText(type)); }

TypeHash hashOf(std::string_view text) {
    std::array<std::uint8_t, 32> whole{};  // SHA-256
    if (EVP_Digest(text.data(), text.size(), whole.data(), nullptr, EVP_sha256(), nullptr) != 1) {
        throw Error{
            "OpenSSL does not compute SHA-256 here, so types cannot be told apart; see "
            "whether its configuration forbids it"};
    }
    TypeHash hash{};
    std::copy_n(whole.begin(), hash.size(), hash.begin());
    return hash;
}

std::string toHex(const TypeHash& hash) {
    constexpr std::string_view digits = "0123456789abcdef";
    std::string result;
    for (const std::uint8_t octet : hash) {
        result += digits[octet >> 4U];
        result += digits[octet & 0xFU];
    }
    return result;
}

std::string Disagreement::text() const {
    const auto side = [](const std::string& text) { return text.empty() ? "nothing" : text; };
    return type + (item.empty() ? "" : " " + item) + ": " +
           (contradiction ? "contradiction" : "difference") + ", ours has " + side(ours) +
           ", theirs " + side(theirs);
}

std::vector<Disagreement> compare(const Type& ours, const Type& theirs) {
    return Comparison{ours, theirs}.run();
}

std::vector<Disagreement> compare(const TypeModel& ours, const TypeModel& theirs) {
    std::vector<Disagreement> result;
    for (const auto& [name, type] : ours.types()) {
        const Type* other = theirs.find(name);
        if (!other) continue;
        auto found = compare(type, *other);
        std::ranges::move(found, std::back_inserter(result));
    }
    return result;
}

}  // namespace cortex
