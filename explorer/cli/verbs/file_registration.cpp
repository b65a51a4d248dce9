// SPDX-License-Identifier: Apache-2.0
#include "verbs/file_registration.hpp"

#include "verbs/live_registration.hpp"
#include "verbs/verb_registration.hpp"
#include "verbs/verbs.hpp"

namespace cortex::cli {
namespace {

CLI::Option* addFiles(CLI::App& verb, Paths& files) {
    return verb
        .add_option("-f,--file", files,
                    "Model files; each may include others, so one is often enough")
        ->type_name("FILE");
}

void addOutput(CLI::App& verb, NewFileOptions& options, const char* description) {
    verb.add_option("-o,--output", options.output, description)->type_name("FILE");
    verb.add_flag("--force", options.force, "Replace a file that exists");
}

// Files or, without them, a network.
void addSource(const Verbs& verbs, CLI::App& verb, Paths& files, NetworkArguments& network) {
    CLI::Option* file = addFiles(verb, files);
    addNetwork(verb, network, verbs.session());
    for (const char* each :
         {"--domain", "--interface", "--peer", "--discovery-server", "--timeout"}) {
        if (CLI::Option* option = verb.get_option_no_throw(each)) option->excludes(file);
    }
}

void addValidate(Verbs& verbs) {
    const auto options = std::make_shared<ValidateOptions>();
    CLI::App* verb = verbs.add(
        "validate", "Check model files as an agent does at its start",
        R"(Every finding is printed: what is wrong where, and what to write instead. Exit code 0: valid,
1: not, 3: a file was not found. A system is made ready to start by cortex-agent, which runs nothing
and talks to no device; so plug-ins that have its classes are loaded, from the folders of cortex-agent
and by --plugin.
Examples:
  cortex validate lbr_teleop.xml                a system, with the types and rules that it names
  cortex validate plant.xml --plugin pump.so    one with a class that this plug-in has
  cortex validate own.xml --model-only          one that a program with classes of its own runs
  cortex validate cortex-morphology.xml         types and rules alone)",
        options, validateFiles);
    verb->add_option("FILE", options->files,
                     "System, ontology or morphology files; together they are one model")
        ->required()
        ->type_name("");
    CLI::Option* plugin =
        verb->add_option("--plugin", options->plugins,
                         "Shared object with classes of active types; once for each")
            ->type_name("FILE")
            ->allow_extra_args(false);
    verb->add_flag("--model-only", options->modelOnly,
                   "Check the files alone, and not what classes of active types say of them")
        ->excludes(plugin);
}

void addDiff(Verbs& verbs) {
    const auto options = std::make_shared<DiffOptions>();
    CLI::App* verb = verbs.add(
        "diff", "Compare the types and rules of two models",
        R"(A contradiction keeps two agents from linking simplexes of that type, a difference is listed and
linked all the same; types that only one model has are no disagreement. Exit code 0: none, 1: some.
Example:
  cortex diff old/cortex-morphology.xml cortex-morphology.xml)",
        options, diffModels);
    verb->add_option("OURS", options->ours, "First model")->required()->type_name("FILE");
    verb->add_option("THEIRS", options->theirs, "Second model")->required()->type_name("FILE");
}

void addTypes(Verbs& verbs) {
    const auto options = std::make_shared<TypesOptions>();
    CLI::App* verb = verbs.add("types", "Show the tree of types, or everything about one",
                               R"(Examples:
  cortex types                                       those of all agents on the network
  cortex types --file cortex-morphology.xml          the tree: who extends whom
  cortex types KukaLbr --file cortex-morphology.xml  its data, commands and relationships, own and
                                                     inherited, and its hash)",
                               options, showTypes);
    verb->add_option("NAME", options->type, "Name of a type")->type_name("");
    addSource(verbs, *verb, options->files, options->network);
}

void addGraph(Verbs& verbs) {
    const auto options = std::make_shared<GraphOptions>();
    CLI::App* verb = verbs.add("graph", "Show relationships and the order of execution",
                               R"(Examples:
  cortex graph                                         all agents on the network
  cortex graph --file lbr_teleop.xml
  cortex graph --dot --file lbr_teleop.xml | dot -Tsvg -o lbr_teleop.svg)",
                               options, showGraph);
    CLI::Option* dot =
        verb->add_flag("--dot", options->dot, "Print a graph in the language of Graphviz");
    dot->excludes(verb->get_option("--json"));
    addSource(verbs, *verb, options->files, options->network);
}

void addNewType(Verbs& verbs) {
    const auto options = std::make_shared<NewTypeOptions>();
    CLI::App* verb = verbs.add(
        "new-type", "Make a commented skeleton of a type and its rules",
        R"(Two files: the ontology says what the type is, the morphology how it is joined to others.
Examples:
  cortex new-type Pump --extends Device                  print both
  cortex new-type Pump --extends Device -o pump.xml      write pump.xml and pump-morphology.xml
  cortex new-type Pump --extends Device Activity         extend two types)",
        options, newType);
    verb->add_option("NAME", options->name, "Name of the new type")->required()->type_name("");
    verb->add_option("-e,--extends", options->parents, "Types that it extends")
        ->required()
        ->delimiter(',')
        ->type_name("TYPE");
    options->file = "cortex-morphology.xml";
    verb->add_option("-f,--file", options->file,
                     "Model that has these types; cortex-morphology.xml if not given")
        ->type_name("FILE");
    addOutput(*verb, *options, "Ontology file to write; the morphology is written beside it");
}

void addNewSystem(Verbs& verbs) {
    const auto options = std::make_shared<NewSystemOptions>();
    CLI::App* verb =
        verbs.add("new-system", "Make a commented skeleton of a system",
                  R"(It is a small system that runs: one simulated axis, held where it is.
Examples:
  cortex new-system                          print it
  cortex new-system mixer -o mixer.xml       write it; then: cortex-agent mixer.xml --startup)",
                  options, newSystem);
    options->name = "plant";
    verb->add_option("NAME", options->name, "Name of the system and its agent; plant if not given")
        ->type_name("");
    addOutput(*verb, *options, "File to write");
}

}  // namespace

void addFileVerbs(Verbs& verbs) {
    addValidate(verbs);
    addDiff(verbs);
    addTypes(verbs);
    addGraph(verbs);
    addNewType(verbs);
    addNewSystem(verbs);
}

}  // namespace cortex::cli
