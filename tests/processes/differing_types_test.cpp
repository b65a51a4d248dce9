// SPDX-License-Identifier: Apache-2.0
// Three agents whose ontologies are not the same: an extension is used through its base type, a
// contradiction is refused with the item that differs, a corrected limit is told and links.
#include "cli/cortex_process.hpp"
#include "comms/inbox.hpp"
#include "processes/station.hpp"

#include <gtest/gtest.h>

namespace cortex::test {
namespace {

const std::string reader = "/desk/reader";

class DifferingTypes : public testing::Test {
protected:
    // A system file with one axis, and the type Axis with these attributes of its position.
    std::filesystem::path plant(const std::string& name, const std::string& position,
                                const std::string& extension = "") {
        folder.write(name + "-types.xml",
                     "<ontology name='axes' version='1.0'><include file='base.xml'/>"
                     "<type name='Axis' extends='Concept'><data name='position' kind='float' " +
                         position + "/></type>" + extension + "</ontology>");
        const std::string type = extension.empty() ? "Axis" : "AxisWithTorque";
        const std::string agent = name.substr(0, name.find('-'));
        return folder.write(name + ".xml",
                            "<system name='" + name + "'><ontology file='" + name +
                                "-types.xml'/><cluster name='" + agent +
                                "' frequency='200'/><simplex path='/" + agent + "/axis' type='" +
                                type + "'><set data='position' value='0.25'/></simplex></system>");
    }
    std::filesystem::path desk() {
        folder.write("desk-rules.xml",
                     "<morphology name='desk' version='1.0'><include file='base-morphology.xml'/>"
                     "<include file='desk-ontology.xml'/><rules type='AxisReader'>"
                     "<relationship name='axes' direction='input' target='Axis' min='0' max='2'/>"
                     "</rules></morphology>");
        folder.write("desk-ontology.xml",
                     "<ontology name='axes' version='1.0'><include file='base.xml'/>"
                     "<type name='Axis' extends='Concept'>"
                     "<data name='position' kind='float' unit='rad' min='-3' max='3'/></type>"
                     "<type name='AxisReader' extends='Active'>"
                     "<data name='seen' kind='float' length='2'/></type></ontology>");
        return folder.write("desk.xml",
                            "<system name='desk'><morphology file='desk-rules.xml'/>"
                            "<cluster name='desk' frequency='200'/>"
                            "<simplex path='/desk/reader' type='AxisReader'>"
                            "<relate rule='axes' to='/one/axis' remote='true'/>"
                            "<relate rule='axes' to='/two/axis' remote='true'/>"
                            "</simplex></system>");
    }
    bool sees(double one, double two) {
        return station.waitFor(
            [&] { return station.reals(reader, "seen") == std::vector<double>{one, two}; });
    }
    // What a person is told of it, both texts.
    bool listed(const std::string& text, const std::string& more) {
        const auto network = comms::loopback();
        return station.waitFor([&] {
            const std::string output =
                cortex({"events", "/two/axis", "--severity", "warning", "--domain",
                        std::to_string(network.domain), "--interface", network.interfaces.front()})
                    .output;
            return output.find(text) != std::string::npos && output.find(more) != std::string::npos;
        });
    }

    ModelFolder folder;
    Station station;
};

TEST_F(DifferingTypes, ExtendLinkThroughTheBaseContradictRefusedLimitsListed) {
    AgentProcess desk{
        folder, this->desk(), {"--plugin", CORTEX_BINARY_DIR "/lib/plugins/axis-reader.so"}};
    AgentProcess one{folder, plant("one", "unit='rad' min='-3' max='3'",
                                   "<type name='AxisWithTorque' extends='Axis'>"
                                   "<data name='torque' kind='float' unit='N.m'/></type>")};
    AgentProcess contrary{folder, plant("two-contrary", "unit='deg' min='-3' max='3'")};

    EXPECT_TRUE(sees(0.25, 0)) << desk.output() << one.output();
    EXPECT_TRUE(listed("Axis position: contradiction, ours has", "deg")) << desk.output();
    EXPECT_TRUE(station.hasEvent("/one/axis", "linked to agent one"));
    EXPECT_FALSE(station.hasEvent("/two/axis", "linked to"));

    EXPECT_EQ(contrary.endInOrder(), 0) << contrary.output();
    AgentProcess corrected{folder, plant("two-corrected", "unit='rad' min='-3' max='2.5'")};

    EXPECT_TRUE(sees(0.25, 0.25)) << desk.output() << corrected.output();
    EXPECT_TRUE(listed("Axis position: difference, ours has", "max=2.5")) << desk.output();
    EXPECT_TRUE(station.hasEvent("/two/axis", "linked to agent two"));
}

}  // namespace
}  // namespace cortex::test
