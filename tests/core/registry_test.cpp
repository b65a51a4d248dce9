// SPDX-License-Identifier: Apache-2.0
#include "cortex/core/registry.hpp"

#include "cortex/core/agreement.hpp"
#include "cortex/core/error.hpp"
#include "cortex/core/simplex_tree.hpp"

#include "core/model_folder.hpp"

#include <array>

#include <gtest/gtest.h>

#if defined(__x86_64__)
#include <immintrin.h>
#endif

namespace cortex {
namespace {

class Valve final : public Simplex {
public:
    using Simplex::Simplex;
};

TypeModel pumps() {
    const test::ModelFolder folder;
    return TypeModel::load(
        folder.write("pumps.xml",
                     "<ontology name=\"pumps\">\n"
                     "<type name=\"Pump\" role=\"active\">"
                     "<data name=\"flow\" kind=\"float\" unit=\"m3/s\"/></type>\n"
                     "<type name=\"Valve\" role=\"active\"/>\n"
                     "</ontology>\n"));
}

std::filesystem::path plugin(const std::string& name) {
    return std::filesystem::path{CORTEX_BINARY_DIR} / "lib/plugins" / ("plugin-" + name + ".so");
}

// Why a plug-in is refused; "" if it is taken.
std::string refusal(const std::filesystem::path& file, ClassRegistry& registry) {
    try {
        registry.loadPlugin(file, pumps());
    } catch (const Error& error) {
        return error.what();
    }
    return "";
}

std::string refusal(const std::string& name) {
    ClassRegistry registry;
    const std::string why = refusal(plugin(name), registry);
    EXPECT_TRUE(registry.names().empty()) << "a refused plug-in left classes behind";
    return why;
}

bool contains(const std::string& text, const std::string& part) {
    return text.find(part) != std::string::npos;
}

TEST(ClassRegistry, MakesObjectsByTypeName) {
    ClassRegistry registry;
    registry.add<Valve>("Valve");
    const TypeModel types = pumps();

    const auto valve = (*registry.find("Valve"))({"/valve", &types.at("Valve")});

    EXPECT_NE(dynamic_cast<Valve*>(valve.get()), nullptr);
    EXPECT_EQ(valve->path(), "/valve");
    EXPECT_EQ(registry.find("Pump"), nullptr);
    EXPECT_EQ(registry.names(), std::vector<std::string>{"Valve"});
}

TEST(ClassRegistry, TakesOneClassForAType) {
    ClassRegistry registry;
    registry.add<Valve>("Valve");

    EXPECT_THROW(registry.add<Valve>("Valve"), Error);
}

TEST(ClassRegistry, GivesATypeWithoutAClassTheOneOfItsNearestAncestor) {
    const test::ModelFolder folder;
    const TypeModel types = TypeModel::load(folder.write("gates.xml", R"(<ontology name="gates">
        <type name="Valve" role="active"/> <type name="Gate" extends="Valve"/>
        <type name="WideGate" extends="Gate"/> <type name="Meter" role="active"/>
        <type name="Late" extends="Valve WideGate"/> <type name="Both" extends="WideGate Meter"/>
        </ontology>)"));
    using Names = std::vector<std::string>;
    ClassRegistry registry;
    EXPECT_EQ(registry.classesFor(types.at("WideGate"), types), Names{});
    registry.add<Valve>("Valve");
    EXPECT_EQ(registry.classesFor(types.at("WideGate"), types), Names{"Valve"});
    registry.add<Valve>("Gate");

    EXPECT_EQ(registry.classesFor(types.at("Gate"), types), Names{"Gate"});
    EXPECT_EQ(registry.classesFor(types.at("Late"), types), Names{"Gate"})
        << "that of Valve is older";
    EXPECT_EQ(registry.classesFor(types.at("Meter"), types), Names{});
    registry.add<Valve>("Meter");
    EXPECT_EQ(registry.classesFor(types.at("Both"), types), (Names{"Gate", "Meter"}));
}

TEST(ClassRegistry, LoadsAPluginAndItsClassesWork) {
    ClassRegistry registry;
    SimplexTree tree{pumps()};

    registry.loadPlugin(plugin("good"), tree.types());

    EXPECT_EQ(registry.names(), (std::vector<std::string>{"Pump", "Turbine"}));
    const auto pump = (*registry.find("Pump"))({"/pump", tree.types().find("Pump")});
    EXPECT_EQ(pump->type().name, "Pump");
}

TEST(ClassRegistry, StatesTheHashOfTheTypeThatThePluginWasMadeFor) {
    const TypeModel types = pumps();

    const std::string why = refusal("wrong-hash");

    EXPECT_TRUE(contains(why, "type Pump with hash 00000000000000000000000000000000")) << why;
    EXPECT_TRUE(contains(why, toHex(typeHash(types.at("Pump"))))) << why;
    EXPECT_TRUE(contains(why, "pumps.xml:2")) << why;
}

TEST(ClassRegistry, RefusesAnotherAbiCompilerOrLibrary) {
    EXPECT_TRUE(contains(refusal("wrong-abi"), "has plug-in ABI 999, this program has 4"));
    EXPECT_TRUE(contains(refusal("wrong-compiler"), "built with compiler 'another compiler 1.0'"));
    EXPECT_TRUE(contains(refusal("wrong-compiler"), compilerOfThisBuild()));
    EXPECT_TRUE(contains(refusal("wrong-library"), "built with 'another library'"));
    EXPECT_TRUE(contains(refusal("wrong-library"), standardLibraryOfThisBuild()));
}

TEST(ClassRegistry, RefusesAPluginThatWasBuiltAgainstOtherHeaders) {
    const std::string why = refusal("wrong-headers");

    EXPECT_TRUE(contains(why, "was built against other headers of cortex (0123456789abcdef)"));
    EXPECT_TRUE(contains(why, headersOfThisBuild())) << why;
    EXPECT_TRUE(contains(why, "build it anew against the installed headers")) << why;
}

TEST(ClassRegistry, TakesAPluginThatGivesNoHashOfATypeAndRefusesOtherNullPointers) {
    ClassRegistry registry;
    registry.loadPlugin(plugin("null-hash"), pumps());
    EXPECT_NE(registry.find("Pump"), nullptr);
    EXPECT_TRUE(contains(refusal("null-text"),
                         "describes itself with null pointers; let CORTEX_PLUGIN(…) make"));
}

TEST(ClassRegistry, RefusesAPluginThatStatesATypeAndRegistersNoClassForIt) {
    EXPECT_TRUE(contains(refusal("unregistered"),
                         "states type Turbine in CORTEX_PLUGIN, but registers no class for it"));
}

TEST(ClassRegistry, RefusesWhatIsNoPlugin) {
    EXPECT_TRUE(contains(refusal("silent"), "exports no cortexPlugin()"));
    EXPECT_TRUE(contains(refusal("absent"), "cannot be loaded"));
    ClassRegistry registry;
    const test::ModelFolder folder;
    EXPECT_TRUE(contains(refusal(folder.write("text.so", "no library"), registry), "text.so"));
}

TEST(ClassRegistry, RefusesClassesThatThePluginDoesNotState) {
    EXPECT_TRUE(contains(refusal("unstated"), "registers a class for type Valve"));
}

TEST(ClassRegistry, RefusesASecondClassForAType) {
    ClassRegistry registry;
    registry.add<Valve>("Pump");

    EXPECT_TRUE(contains(refusal(plugin("good"), registry), "second class for type Pump"));
    EXPECT_EQ(registry.names().size(), 1U);
}

#if defined(__x86_64__)
TEST(ClassRegistry, RefusesAPluginThatChangesTheFloatingPointModeAndRestoresIt) {
    const unsigned before = _mm_getcsr() & 0xffc0U;

    const std::string why = refusal("fast-math");

    EXPECT_TRUE(contains(why, "changes the floating-point mode")) << why;
    EXPECT_EQ(_mm_getcsr() & 0xffc0U, before);
}
#endif

// Each tenth of a hundredth of it; what is left of one that ends behind its last part may load.
TEST(Plugin, ThatWasCutOffIsRefusedInWordsAtEachLength) {
    const test::ModelFolder folder;
    const std::string whole = test::textOf(plugin("good"));
    ASSERT_GT(whole.size(), 10'000U);
    std::size_t refused = 0;
    for (std::size_t part = 0; part < 100; ++part) {
        ClassRegistry registry;
        const auto file = folder.write("cut" + std::to_string(part) + ".so",
                                       whole.substr(0, whole.size() * part / 100));
        const std::string why = refusal(file, registry);
        if (why.empty()) continue;
        ++refused;
        EXPECT_TRUE(contains(why, "is cut off: it has ") || contains(why, "cannot be loaded: "))
            << part << " %: " << why;
    }
    EXPECT_GT(refused, 5U);
}

}  // namespace
}  // namespace cortex
