// SPDX-License-Identifier: Apache-2.0
#include "cortex/core/model_files.hpp"

#include "cortex/core/error.hpp"
#include "cortex/core/nearest_names.hpp"

#include "base/bounds.hpp"
#include "files/element_reader.hpp"
#include "files/model_path.hpp"
#include "files/ontology_reader.hpp"
#include "files/system_reader.hpp"

#include <algorithm>
#include <array>
#include <iterator>
#include <utility>

namespace cortex {

namespace {

namespace fs = std::filesystem;
using Child = ElementReader::Child;

struct FileElement {
    std::string name, version;
};
constexpr std::array fileAttributes{
    AttributeReader<FileElement>{
        "name", [](FileElement& file, std::string_view text) { return readText(file.name, text); },
        true},
    AttributeReader<FileElement>{
        "version",
        [](FileElement& file, std::string_view text) { return readText(file.version, text); }},
    // For editors that look up the schema by it.
    AttributeReader<FileElement>{"xmlns:xsi",
                                 [](FileElement&, std::string_view) { return std::string{}; }},
    AttributeReader<FileElement>{"xsi:noNamespaceSchemaLocation",
                                 [](FileElement&, std::string_view) { return std::string{}; }},
};
constexpr std::array includeAttributes{AttributeReader<std::string>{
    "file", [](std::string& file, std::string_view text) { return readText(file, text); }, true}};

// What a file may be, where it is asked for.
enum class Asked { Any, OntologyOrMorphology, Ontology, Morphology };

bool fits(std::string_view root, Asked asked) {
    if (root == "ontology") return asked != Asked::Morphology;
    if (root == "morphology") return asked != Asked::Ontology;
    return root == "system" && asked == Asked::Any;
}

const char* wanted(Asked asked) {
    switch (asked) {
        case Asked::Any:
            return "ontology, morphology or system";
        case Asked::OntologyOrMorphology:
            return "ontology or morphology";
        case Asked::Ontology:
            return "ontology";
        case Asked::Morphology:
            return "morphology";
    }
    return "";
}

// Reads files with what they include, depth first, so that the order is that of the text.
class FileReader {
public:
    explicit FileReader(Report& report) : report_{report} {}

    ModelFiles run(std::span<const fs::path> files) {
        for (const fs::path& file : files) open(file, Place{}, Asked::Any);
        joinRules();
        result_.types = TypeModel::build(std::move(declarations_), report_);
        return std::move(result_);
    }

private:
    void open(const fs::path& wantedFile, const Place& from, Asked asked) {
        const FoundFile found = findModelFile(wantedFile, from.file);
        if (!found.file) {
            report_.error("", finding::fileMissing, from,
                          "there is no file " + inQuotes(wantedFile.string()) + "; looked for " +
                              found.lookedFor,
                          "correct the name, or add its folder to CORTEX_PATH");
            return;
        }
        std::error_code ignored;
        const fs::path canonical = fs::weakly_canonical(*found.file, ignored);
        if (loops(canonical, from)) return;
        if (const auto known = roots_.find(canonical); known != roots_.end()) {
            checkKind(known->second, from, asked, found.file->string());
            return;
        }
        if (result_.files.size() == bounds::files) {
            if (std::exchange(full_, true)) return;
            report_.error("", finding::fileCount, from,
                          "there are more than " + std::to_string(bounds::files) + " files",
                          "join small ones");
            return;
        }
        result_.files.push_back(*found.file);
        open_.push_back({canonical, found.file->string()});
        roots_[canonical] = "";
        read(*found.file, canonical, from, asked);
        open_.pop_back();
    }

    void read(const fs::path& path, const fs::path& canonical, const Place& from, Asked asked) {
        const std::string file = path.string();
        const auto content = readModelFile(path, bounds::totalSize - octets_, report_);
        if (!content) return;
        octets_ += content->size();
        const auto root = parseXml(file, *content, report_);
        if (!root) return;
        roots_[canonical] = root->name;
        if (!fits(root->name, Asked::Any)) {
            const ElementReader reader{file, report_, ""};
            reader.unknown(finding::unknownElement, root->line,
                           "the file's element is <" + root->name.substr(0, 80) + ">", root->name,
                           {"ontology", "morphology", "system"});
            return;
        }
        checkKind(root->name, from, asked, file);
        readRoot(*root, file);
    }

    void checkKind(const std::string& root, const Place& from, Asked asked,
                   const std::string& file) {
        if (root.empty() || fits(root, asked)) return;
        report_.error("", finding::fileKind, from,
                      inQuotes(file) + " has the element <" + root.substr(0, 80) + ">, wanted is " +
                          wanted(asked),
                      root == "system" ? "include it in a system, or give it to the program itself"
                                       : "write <" + root.substr(0, 80) +
                                             " file=\"…\"/> or <include file=\"…\"/>");
    }

    bool loops(const fs::path& canonical, const Place& from) {
        const auto begin = std::ranges::find(open_, canonical, &OpenFile::canonical);
        if (begin == open_.end()) return false;
        std::string loop;
        for (auto each = begin; each != open_.end(); ++each) loop += each->shown + " → ";
        report_.error("", finding::includeLoop, from,
                      "files include each other: " + loop + begin->shown,
                      "remove one of the includes");
        return true;
    }

    void readRoot(const XmlElement& root, const std::string& file) {
        const ElementReader reader{file, report_, ""};
        FileElement named;
        reader.attributes(root, std::span<const AttributeReader<FileElement>>{fileAttributes},
                          named);
        const auto including = [&](const char* element, Asked asked) {
            return Child{element, [&, asked](const XmlElement& child) {
                             std::string wantedFile;
                             const bool complete = reader.attributes(
                                 child,
                                 std::span<const AttributeReader<std::string>>{includeAttributes},
                                 wantedFile);
                             reader.children(child, {});
                             if (complete) open(wantedFile, reader.place(child.line), asked);
                         }};
        };
        const bool system = root.name == "system";
        std::vector<Child> children{
            including("include", system ? Asked::Any : Asked::OntologyOrMorphology)};
        if (root.name == "ontology") {
            children.push_back({"type", [&](const XmlElement& child) { addType(child, file); }});
        } else if (root.name == "morphology") {
            children.push_back({"rules", [&](const XmlElement& child) { addRules(child, file); }});
        } else {
            startSystem(named, reader.place(root.line));
            children.push_back(including("ontology", Asked::Ontology));
            children.push_back(including("morphology", Asked::Morphology));
            children.push_back({"cluster", [&](const XmlElement& child) {
                                    readCluster(child, file, result_.system, paths_, report_);
                                }});
            children.push_back({"simplex", [&](const XmlElement& child) {
                                    readSimplex(child, file, result_.system, paths_, report_);
                                }});
        }
        reader.children(root, children);
    }

    void startSystem(const FileElement& named, Place place) {
        if (std::exchange(result_.hasSystem, true)) return;
        result_.system.name = named.name;
        result_.system.place = std::move(place);
    }

    void addType(const XmlElement& element, const std::string& file) {
        TypeDeclaration type = readType(element, file, report_);
        if (!element.find("name")) return;
        declarations_.push_back(std::move(type));
    }

    void addRules(const XmlElement& element, const std::string& file) {
        RuleBlock block = readRules(element, file, report_);
        if (element.find("type")) ruleBlocks_.push_back(std::move(block));
    }

    // Rules may stand before their type, in any morphology.
    void joinRules() {
        std::map<std::string, std::size_t> byName;
        for (std::size_t i = 0; i < declarations_.size(); ++i)
            byName.emplace(declarations_[i].name, i);
        for (RuleBlock& block : ruleBlocks_) {
            const auto found = byName.find(block.type);
            if (found == byName.end()) {
                unknownRuleType(block, byName);
                continue;
            }
            TypeDeclaration& type = declarations_[found->second];
            std::ranges::move(block.rules, std::back_inserter(type.rules));
            type.stated.merge(block.stated);
        }
    }

    void unknownRuleType(const RuleBlock& block, const std::map<std::string, std::size_t>& byName) {
        std::vector<std::string> valid;
        if (suggestions_ > 0) {
            --suggestions_;
            for (const auto& [name, index] : byName) valid.push_back(name);
        }
        const std::string near = nearestNames(block.type, valid);
        report_.error(
            block.type, finding::unknownType, block.place,
            "rules are given for the type " + inQuotes(block.type) + ", which is not known",
            near.empty() ? "include the ontology that declares it" : near);
    }

    struct OpenFile {
        fs::path canonical;
        std::string shown;
    };

    Report& report_;
    ModelFiles result_;
    std::vector<TypeDeclaration> declarations_;
    std::vector<RuleBlock> ruleBlocks_;
    std::map<std::string, Place> paths_;
    std::size_t suggestions_ = bounds::suggestions;
    std::vector<OpenFile> open_;
    std::map<fs::path, std::string> roots_;
    std::size_t octets_ = 0;
    bool full_ = false;
};

}  // namespace

ModelFiles readModelFiles(std::span<const fs::path> files, Report& report) {
    return FileReader{report}.run(files);
}

TypeModel TypeModel::load(std::span<const std::filesystem::path> files) {
    Report report;
    ModelFiles read = readModelFiles(files, report);
    if (!report.ok()) throw ModelError{std::move(report)};
    return std::move(read.types);
}

TypeModel TypeModel::load(const std::filesystem::path& file) { return load(std::span{&file, 1}); }

}  // namespace cortex
