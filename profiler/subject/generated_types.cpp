// SPDX-License-Identifier: Apache-2.0
#include "generated_types.hpp"

#include "cortex/core/error.hpp"

#include <cstdlib>
#include <filesystem>
#include <fstream>
#include <vector>

namespace cortex::profiler {
namespace {

class CommandedSimplex final : public cs::SimplexCS {
public:
    using SimplexCS::SimplexCS;
    int commands = 0;

private:
    void populate() override {
        for (int i = 0; i < commands; ++i) {
            on<&CommandedSimplex::ignore>("c" + std::to_string(i));
        }
    }
    Outcome ignore(Call& /*call*/) { return Outcome::Done; }
};

std::string items(Content content, int each) {
    std::string text;
    for (int i = 0; i < each; ++i) {
        const std::string number = std::to_string(i);
        if (content == Content::Data) {
            text += "    <data name=\"d" + number + "\" kind=\"float\"/>\n";
        } else if (content == Content::Commands) {
            text += "    <command name=\"c" + number +
                    "\" available=\"always\"><request name=\"value\" kind=\"float\"/></command>\n";
        }
    }
    return text;
}

// Of the repository, wherever the file lies that includes it.
std::string include(const std::string& file) {
    return "  <include file=\"" CORTEX_SOURCE_DIR "/ontology/" + file + "\"/>\n";
}

TypeModel types(Content content, int each) {
    std::string folder =
        (std::filesystem::temp_directory_path() / "cortex-profiler-XXXXXX").string();
    if (mkdtemp(folder.data()) == nullptr) throw Error("no folder for files: " + folder);
    std::ofstream{folder + "/types.xml"}
        << "<ontology name=\"generated\" version=\"1.0\">\n"
        << include("base.xml") << "  <type name=\"Loaded\" extends=\"Active\">\n"
        << items(content, each) << "  </type>\n  <type name=\"Target\" extends=\"Concept\"/>\n"
        << "</ontology>\n";
    std::ofstream{folder + "/rules.xml"}
        << "<morphology name=\"generated\" version=\"1.0\">\n"
        << include("base-morphology.xml") << "  <include file=\"types.xml\"/>\n"
        << "  <rules type=\"Loaded\">\n"
        << "    <relationship name=\"related\" direction=\"input\" target=\"Target\"/>\n"
        << "  </rules>\n</morphology>\n";
    TypeModel model = TypeModel::load(folder + "/rules.xml");
    std::filesystem::remove_all(folder);
    return model;
}

}  // namespace

SimplexTree Loaded::tree(Content content, int each) {
    SimplexTree tree{types(content, each)};
    std::vector<Simplex*> targets;
    for (int i = 0; content == Content::Relationships && i < most; ++i) {
        targets.push_back(&tree.add("/t" + std::to_string(i), "Target"));
    }
    for (int i = 0; i < simplexes; ++i) {
        auto& simplex = tree.add<CommandedSimplex>("/s" + std::to_string(i), "Loaded");
        if (content == Content::Commands) simplex.commands = each;
        for (int n = 0; content == Content::Relationships && n < each; ++n) {
            tree.relate(simplex, "related", *targets[static_cast<std::size_t>(n)]);
        }
    }
    return tree;
}

}  // namespace cortex::profiler
