// SPDX-License-Identifier: Apache-2.0
#include "cortex/core/findings.hpp"
#include "cortex/core/type_description.hpp"

#include "base/bounds.hpp"
#include "base/text.hpp"
#include "files/ontology_reader.hpp"
#include "types/stated.hpp"

#include <algorithm>
#include <cstddef>
#include <map>
#include <set>
#include <utility>

namespace cortex {

namespace {

using Attributes = std::vector<DescribedAttribute>;

// Whether a file could say what a description says; and what all of them cost together, so that
// hostile ones are refused before anything is made of them.
class FormCheck {
public:
    // "" or what is wrong.
    std::string check(const TypeDescription& type) {
        wrong_.clear();
        addElement(type.name, type.description, type.attributes);
        if (type.parents.size() > bounds::parents) refuse("more than 64 parents");
        for (const std::string& parent : type.parents) addName(parent, "parent");
        for (const DescribedItem& each : type.data) addItem(each);
        for (const DescribedCommand& each : type.commands) {
            addElement(each.name, each.description, each.attributes);
            // Each takes 8 bytes or more.
            constexpr std::size_t most = bounds::recordSize / 8;
            if (std::max(each.request.size(), each.response.size()) > most) {
                refuse("a command with more than 512 parameters");
                return wrong_;
            }
            for (const DescribedItem& parameter : each.request) addItem(parameter);
            for (const DescribedItem& parameter : each.response) addItem(parameter);
        }
        for (const DescribedRule& each : type.rules) {
            addElement(each.name, each.description, each.attributes);
        }
        return wrong_;
    }
    bool tooLarge() const { return octets_ > bounds::totalSize || elements_ > bounds::elements; }

private:
    void refuse(const std::string& why) {
        if (wrong_.empty()) wrong_ = why;
    }

    void addText(const std::string& text) {
        constexpr std::size_t cost = 16;
        octets_ += text.size() + cost;
        if (text.find('\0') != std::string::npos || !isUtf8(text)) refuse("text that is not UTF-8");
    }

    void addName(const std::string& name, const std::string& what) {
        addText(name);
        if (!isName(name)) refuse("the " + what + " " + inQuotes(name) + ", which is not a name");
    }

    // A name, or several joined by dots: later versions may group their attributes.
    void addAttributeName(const std::string& name) {
        addText(name);
        std::size_t begin = 0;
        for (std::size_t end = 0; end != std::string::npos; begin = end + 1) {
            end = name.find('.', begin);
            if (isName(name.substr(begin, end - begin))) continue;
            return refuse("the attribute " + inQuotes(name) + ", which is not a name");
        }
    }

    void addItem(const DescribedItem& item) {
        addElement(item.name, item.description, item.attributes);
    }

    void addElement(const std::string& name, const std::string& description,
                    const Attributes& attributes) {
        ++elements_;
        addText(name);
        addText(description);
        if (attributes.size() > bounds::attributes) {
            refuse("more than 64 attributes of one item");
            return;
        }
        // These have places of their own.
        std::set<std::string_view> names{"description", "extends", "name"};
        for (const DescribedAttribute& each : attributes) {
            addAttributeName(each.name);
            addText(each.text);
            if (!names.insert(each.name).second) {
                refuse("the attribute " + inQuotes(each.name) + " twice");
            }
        }
    }

    std::string wrong_;
    std::size_t octets_ = 0, elements_ = 0;
};

// A description as the elements of a file that says the same, but for what it inherits.
XmlElement element(const char* kind, const char* nameAttribute, const std::string& name,
                   const std::string& description, const Attributes& attributes) {
    XmlElement result;
    result.name = kind;
    result.attributes.push_back({nameAttribute, name});
    if (!description.empty()) result.attributes.push_back({"description", description});
    for (const DescribedAttribute& each : attributes) {
        result.attributes.push_back({each.name, each.text});
    }
    return result;
}

void addItems(XmlElement& owner, const char* kind, const std::vector<DescribedItem>& items) {
    for (const DescribedItem& each : items) {
        owner.children.push_back(
            element(kind, "name", each.name, each.description, each.attributes));
    }
}

XmlElement typeElement(const TypeDescription& type) {
    XmlElement result = element("type", "name", type.name, type.description, type.attributes);
    std::string extends;
    for (const std::string& each : type.parents) extends += (extends.empty() ? "" : " ") + each;
    if (!extends.empty()) result.attributes.push_back({"extends", extends});
    addItems(result, "data", type.data);
    for (const DescribedCommand& each : type.commands) {
        XmlElement command =
            element("command", "name", each.name, each.description, each.attributes);
        addItems(command, "request", each.request);
        addItems(command, "response", each.response);
        result.children.push_back(std::move(command));
    }
    return result;
}

XmlElement rulesElement(const TypeDescription& type) {
    XmlElement result = element("rules", "type", type.name, "", {});
    for (const DescribedRule& each : type.rules) {
        result.children.push_back(
            element("relationship", "name", each.name, each.description, each.attributes));
    }
    return result;
}

// Makes types of descriptions; everything found goes to the report, of one type not too much.
class Reader {
public:
    explicit Reader(Report& report) : report_{report} {}

    TypeModel run(std::span<const TypeDescription> types) {
        const std::vector<const TypeDescription*> sound = check(types);
        std::vector<TypeDeclaration> declarations = read(sound);
        Report found;
        TypeModel model = TypeModel::build(declarations, found);
        take(found);
        compareHashes(sound, model);
        leaveOutChildren(model);
        if (wrong_.empty()) return model;
        std::erase_if(declarations, [&](const auto& each) { return wrong_.contains(each.name); });
        Report known;  // what lacks a target now
        return TypeModel::build(std::move(declarations), known);
    }

private:
    void error(const std::string& type, const char* rule, const std::string& message,
               const std::string& remedy) {
        Report found;
        found.error(isName(type) ? type : "", rule, {}, message, remedy);
        take(found);
    }

    void take(const Report& found) {
        constexpr std::size_t most = 20;
        for (const Finding& each : found.findings) {
            if (each.severity == Severity::Error) wrong_.insert(each.path);
            if (++findings_[each.path] <= most) report_.add(each);
        }
    }

    std::vector<const TypeDescription*> check(std::span<const TypeDescription> types) {
        FormCheck form;
        std::vector<const TypeDescription*> sound;
        for (const TypeDescription& each : types) {
            const std::string wrong = form.check(each);
            if (form.tooLarge()) {
                error(each.name, finding::modelSize,
                      "the descriptions up to this type are larger than 64 MiB or have more than " +
                          std::to_string(bounds::elements) + " items",
                      "divide the model");
                break;
            }
            if (wrong.empty()) {
                sound.push_back(&each);
            } else {
                error(each.name, finding::typeDescription, "its description has " + wrong,
                      "describe it as docs/protocol.md says");
            }
        }
        return sound;
    }

    std::vector<TypeDeclaration> read(const std::vector<const TypeDescription*>& types) {
        std::vector<TypeDeclaration> declarations;
        for (const TypeDescription* each : types) {
            Report found;
            TypeDeclaration type = readType(typeElement(*each), "", found, Unknown::Kept);
            RuleBlock block = readRules(rulesElement(*each), "", found, Unknown::Kept);
            type.rules = std::move(block.rules);
            type.stated.merge(block.stated);
            type.stated.insert(wholeType);
            declarations.push_back(std::move(type));
            take(found);
        }
        return declarations;
    }

    void compareHashes(const std::vector<const TypeDescription*>& types, const TypeModel& model) {
        for (const TypeDescription* each : types) {
            const Type* type = model.find(each->name);
            if (type == nullptr || wrong_.contains(each->name)) continue;
            const TypeHash hash = typeHash(*type);
            if (hash == each->hash) continue;
            error(each->name, finding::typeHash,
                  "says that its hash is " + toHex(each->hash) + ", it is " + toHex(hash),
                  "run one version of CorteX and of the ontology on both sides");
        }
    }

    void leaveOutChildren(const TypeModel& model) {
        const std::set<std::string, std::less<>> wrong = wrong_;
        for (const auto& [name, type] : model.types()) {
            const auto parent = std::ranges::find_if(
                type.ancestors, [&](const std::string& each) { return wrong.contains(each); });
            if (parent == type.ancestors.end() || wrong.contains(name)) continue;
            error(name, finding::unknownParent,
                  "extends " + inQuotes(*parent) + ", which is left out", "mend that type first");
        }
    }

    Report& report_;
    std::set<std::string, std::less<>> wrong_;  // types with an error
    std::map<std::string, std::size_t> findings_;
};

}  // namespace

TypeModel modelOf(std::span<const TypeDescription> types, Report& report) {
    return Reader{report}.run(types);
}

}  // namespace cortex
