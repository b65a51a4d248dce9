// SPDX-License-Identifier: Apache-2.0
#include "cortex/core/nearest_names.hpp"

#include "models/new_type_text.hpp"
#include "text/new_files.hpp"
#include "verbs/verbs.hpp"

#include <algorithm>
#include <array>

namespace cortex::cli {
namespace {

namespace fs = std::filesystem;

void checkName(const std::string& name) {
    const auto letter = [](char c) {
        return (c >= 'A' && c <= 'Z') || (c >= 'a' && c <= 'z') || c == '_';
    };
    const bool valid = !name.empty() && name.size() <= 64 && letter(name.front()) &&
                       std::ranges::all_of(name, [&](char c) {
                           return letter(c) || (c >= '0' && c <= '9') || c == '-';
                       });
    if (valid) return;
    throw Failure{Usage,
                  "'" + name +
                      "' cannot name a type: a letter or _ first, then letters, digits, _ and "
                      "-, at most 64 characters" +
                      fileNameHint(name)};
}

void checkParents(const TypeModel& types, const std::vector<std::string>& parents) {
    std::vector<std::string> names;
    for (const auto& [name, type] : types.types()) names.push_back(name);
    for (const std::string& parent : parents) {
        if (types.find(parent) != nullptr) continue;
        const std::string nearest = nearestNames(parent, names);
        throw Failure{NotFound, "there is no type '" + parent + "' to extend" +
                                    (nearest.empty() ? "" : "; " + nearest)};
    }
}

// The type as the model would have it, which also tells whether its parents agree.
Type resolve(const TypeModel& types, const NewTypeOptions& options) {
    std::vector<TypeDeclaration> declarations;
    for (const auto& [name, declaration] : types.declarations())
        declarations.push_back(declaration);
    TypeDeclaration added;
    added.name = options.name;
    added.parents = options.parents;
    added.isAbstract = true;  // as long as a unit is open
    declarations.push_back(std::move(added));
    Report report;
    const TypeModel extended = TypeModel::build(std::move(declarations), report);
    if (!report.ok()) throw Failure{No, "such a type would not be valid", report};
    Type type = extended.at(options.name);
    type.isAbstract =
        std::ranges::any_of(type.data, [](const DataItem& item) { return item.unit == "*"; });
    return type;
}

// The folder of $CORTEX_PATH or the installation in which a file was found; none: it was found as
// it was given.
std::optional<fs::path> searchFolder(const fs::path& given, const fs::path& found) {
    if (found == given.lexically_normal()) return std::nullopt;
    fs::path folder = found;
    for (const auto& part : given.lexically_normal()) {
        if (!part.empty()) folder = folder.parent_path();
    }
    return folder;
}

// How a file in `outputFolder` refers to one that was read.
std::string reference(const fs::path& file, const std::optional<fs::path>& searched,
                      const fs::path& outputFolder) {
    if (searched) {
        const fs::path inside = file.lexically_relative(*searched);
        if (!inside.empty() && *inside.begin() != "..") return inside.string();
    }
    std::error_code ignored;
    const fs::path folder = outputFolder.empty() ? fs::path{"."} : outputFolder;
    return fs::proximate(file, folder, ignored).string();
}

}  // namespace

Exit newType(const NewTypeOptions& options) {
    checkName(options.name);
    const Model model = readTypes(std::array{options.file});
    requireValid(model);
    checkParents(model.types(), options.parents);
    if (const Type* taken = model.types().find(options.name)) {
        throw Failure{No, "there is a type '" + options.name + "' already, at " +
                              taken->place.text() + "; choose another name"};
    }
    fs::path ontology = options.output;
    std::error_code ignored;
    if (ontology.empty() || fs::is_directory(ontology, ignored)) ontology /= options.name + ".xml";
    fs::path morphology = ontology;
    morphology.replace_filename(ontology.stem().string() + "-morphology.xml");

    const auto searched = searchFolder(options.file, model.files.front());
    const fs::path folder = ontology.parent_path();
    NewTypeText text{
        resolve(model.types(), options),
        options.parents,
        ontology.filename().string(),
        morphology.filename().string(),
        {},
        reference(model.files.front(), searched, folder),
        model.types().find("Concept") != nullptr ? "Concept" : options.parents.front()};
    for (const std::string& parent : options.parents) {
        const fs::path declared{model.types().at(parent).place.file};
        const std::string file = reference(declared, searched, folder);
        if (std::ranges::count(text.ontologies, file) == 0) text.ontologies.push_back(file);
    }
    deliver({{ontology, ontologyText(text)}, {morphology, morphologyText(text)}}, options);
    return Yes;
}

}  // namespace cortex::cli
