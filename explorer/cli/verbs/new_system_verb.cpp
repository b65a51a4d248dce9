// SPDX-License-Identifier: Apache-2.0
#include "verbs/verbs.hpp"

namespace cortex::cli {
namespace {

constexpr std::string_view skeleton = R"(<?xml version="1.0" encoding="UTF-8"?>
<!-- The system {name}: which simplexes there are and how they are joined.
     As it stands it is one simulated axis that is held where it is. Check it, look at it, run it:
       cortex validate {file}
       cortex graph -f {file}
       cortex-agent {file}     (its option "startup" starts everything at once) -->
<system name="{name}">
  <!-- The types and rules that it is made of. Files are looked for beside this one, then in
       $CORTEX_PATH, then in the installed share/cortex. -->
  <morphology file="cortex-morphology.xml"/>

  <!-- The agent: its name, cycles per second, threads, real-time priority, and what happens when a
       cycle takes too long (skip, catchUp or halt). Its own simplex is /{name}. -->
  <cluster name="{name}" frequency="1000" threads="1" priority="0" overflow="skip"/>

  <!-- Data: the axis as it is, and as it is wished to be. A path is a name in the plant; what can be
       at it, and with which data, says the type: cortex types RotaryAxisConcept -f {file} -->
  <simplex path="/axis/observed" type="RotaryAxisConcept"/>
  <simplex path="/axis/demanded" type="RotaryAxisConcept"/>

  <!-- A device takes demands and gives observations. Another drive is another type here, and nothing
       else changes. What <set> says outranks the default of the type. -->
  <simplex path="/drive" type="SimulatedAxis">
    <relate rule="demand" to="/axis/demanded"/>
    <relate rule="observation" to="/axis/observed"/>
    <set data="startPosition" value="0.5"/>
  </simplex>

  <!-- A controller makes demands. Relationships give the order of execution: whoever reads a simplex
       runs after whoever writes it. every="10" would run it in each tenth cycle. -->
  <simplex path="/controller" type="HoldAxisController">
    <relate rule="axes" to="/axis/observed"/>
    <relate rule="demands" to="/axis/demanded"/>
  </simplex>
</system>
)";

}  // namespace

Exit newSystem(const NewSystemOptions& options) {
    const std::string wrong = SimplexTree::pathError("/" + options.name);
    if (!wrong.empty() || options.name.find('/') != std::string::npos) {
        throw Failure{Usage,
                      "'" + options.name +
                          "' cannot name a system: use A-Z a-z 0-9 _ -, at most 127 characters" +
                          fileNameHint(options.name)};
    }
    std::filesystem::path file = options.output;
    std::error_code ignored;
    if (file.empty() || std::filesystem::is_directory(file, ignored)) {
        file /= options.name + ".xml";
    }
    const std::vector<Substitution> values{
        {"name", options.name},
        {"file", xmlComment(file.filename().string())},
    };
    deliver({{file, filledIn(skeleton, values)}}, options);
    return Yes;
}

}  // namespace cortex::cli
