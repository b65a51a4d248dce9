// SPDX-License-Identifier: Apache-2.0
#include "peers/peer_model.hpp"

#include "cortex/core/type_description.hpp"

#include "comms/told_agent.hpp"
#include "wire/cdr.hpp"
#include "wire/ids.hpp"
#include "wire/named_values.hpp"
#include "wire/type_messages.hpp"

#include <algorithm>
#include <cstdint>
#include <span>
#include <vector>

#include <gtest/gtest.h>

namespace cortex::comms {
namespace {

PeerModel peerOf(const ToldAgent& agent) { return PeerModel{agent.name(), agent.epoch()}; }

void expectSameSimplex(const Structure& ours, const Structure& theirs, std::uint32_t index) {
    const SimplexInfo& left = ours.simplexes[index];
    const SimplexInfo& right = theirs.simplexes[index];
    EXPECT_EQ(left.path, right.path);
    EXPECT_EQ(left.layout->type->name, right.layout->type->name);
    EXPECT_EQ(left.role, right.role) << left.path;
    EXPECT_EQ(left.every, right.every) << left.path;
    EXPECT_EQ(left.phase, right.phase) << left.path;
    EXPECT_EQ(left.remote, right.remote) << left.path;
    EXPECT_EQ(left.base.floats, right.base.floats) << left.path;
    EXPECT_EQ(left.base.strings, right.base.strings) << left.path;
    ASSERT_EQ(left.layout->items.size(), right.layout->items.size()) << left.path;
    for (std::size_t i = 0; i < left.layout->items.size(); ++i) {
        EXPECT_EQ(left.layout->items[i].item->name, right.layout->items[i].item->name);
        EXPECT_EQ(left.layout->items[i].offset, right.layout->items[i].offset);
    }
}

// What a peer that was told this makes of it: "" if a structure, else the first finding.
std::string refusal(const ToldAgent& agent) {
    PeerModel peer = peerOf(agent);
    tell(agent, peer);
    EXPECT_TRUE(peer.complete());
    if (peer.structure()) return "";
    return peer.findings().findings.empty() ? "?" : peer.findings().findings.front().text();
}

bool contains(const std::string& text, const std::string& part) {
    return text.find(part) != std::string::npos;
}

TEST(PeerModel, MakesTheStructureThatItsOwnerHas) {
    const ToldAgent agent;
    PeerModel peer = peerOf(agent);

    tell(agent, peer);

    ASSERT_TRUE(peer.complete());
    const auto structure = peer.structure();
    ASSERT_TRUE(structure) << peer.findings().text();
    EXPECT_EQ(structure->agent, "rig");
    EXPECT_EQ(structure->epoch, agent.epoch());
    ASSERT_EQ(structure->simplexes.size(), agent.structure().simplexes.size());
    for (std::uint32_t i = 0; i < structure->simplexes.size(); ++i) {
        expectSameSimplex(agent.structure(), *structure, i);
    }
    ASSERT_EQ(structure->edges.size(), agent.structure().edges.size());
    for (std::size_t i = 0; i < structure->edges.size(); ++i) {
        EXPECT_EQ(structure->edges[i].owner, agent.structure().edges[i].owner);
        EXPECT_EQ(structure->edges[i].target, agent.structure().edges[i].target);
        EXPECT_EQ(structure->edges[i].rule->name, agent.structure().edges[i].rule->name);
        EXPECT_EQ(structure->edges[i].delayed, agent.structure().edges[i].delayed);
    }
    EXPECT_EQ(peer.refused(), 0U);
}

std::vector<double> agesIn(const Structure& structure) {
    std::vector<double> ages;
    for (const Edge& each : structure.edges) ages.push_back(each.maxAge);
    return ages;
}

TEST(PeerModel, HasTheAgesThatRelationshipsOfTheOwnerAllow) {
    ToldAgent agent;
    for (Model& each : agent.models) {
        std::vector<std::uint8_t> sent(encodedSize(each));
        ASSERT_EQ(encode(each, sent), sent.size());
        each = {};
        ASSERT_TRUE(decode(std::span<const std::uint8_t>{sent}, each));
    }
    PeerModel peer = peerOf(agent);
    tell(agent, peer);
    const auto structure = peer.structure();
    ASSERT_TRUE(structure) << peer.findings().text();

    EXPECT_EQ(agesIn(*structure), agesIn(agent.structure()));
    EXPECT_EQ(std::ranges::count(agesIn(*structure), 2.5), 1);
    EXPECT_EQ(std::ranges::count(agesIn(*structure), 0.1), 1);
}

TEST(PeerModel, RefusesAgesOfNothingAndAgesThatAreNone) {
    for (const char* each :
         {"", "/boss", "/boss readings /reading", "/boss readings /reading 2.5 more",
          "/boss readings /plate 2.5", "/boss late /reading 2.5", "/nobody readings /reading 2.5",
          "/boss readings /reading nan", "/boss readings /reading inf", "/boss readings /reading 0",
          "/boss readings /reading -1"}) {
        ToldAgent agent;
        const auto boss = std::ranges::find_if(agent.models, [](const Model& model) {
            return std::ranges::find(model.simplexes, "/boss", &SimplexMessage::path) !=
                   model.simplexes.end();
        });
        boss->extras.push_back({"maxAge", each});
        PeerModel peer = peerOf(agent);
        tell(agent, peer);
        EXPECT_EQ(peer.refused(), 1U) << each;
        EXPECT_FALSE(peer.complete()) << each;
    }
}

TEST(PeerModel, HasTheConstantsOfTheOwner) {
    const ToldAgent agent;
    PeerModel peer = peerOf(agent);
    tell(agent, peer);
    const auto structure = peer.structure();
    ASSERT_TRUE(structure);

    ASSERT_EQ(structure->initial.size(), 1U);
    EXPECT_EQ(structure->simplexes[structure->initial[0].simplex].path, "/reading");
    EXPECT_EQ(structure->initial[0].value, Value(std::vector{1.5, -2.0, 0.25}));
}

TEST(PeerModel, CountsWhatIsMissingUntilAllIsThere) {
    const ToldAgent agent;
    PeerModel peer = peerOf(agent);
    EXPECT_FALSE(peer.complete());

    peer.add(agent.presence);
    std::size_t missing = agent.presence.types + agent.presence.simplexes;
    EXPECT_EQ(peer.missing(), missing);
    EXPECT_GT(agent.models.size(), 1U);
    for (const Model& model : agent.models) {
        EXPECT_FALSE(peer.complete());
        EXPECT_EQ(peer.structure(), nullptr);
        EXPECT_TRUE(peer.add(model));
        EXPECT_TRUE(peer.add(model)) << "a repeat is no fault";
        missing -= model.types.size() + model.simplexes.size();
        EXPECT_EQ(peer.missing(), missing);
    }
    EXPECT_TRUE(peer.complete());
}

TEST(PeerModel, NamesTypesThatWereNamedAndHaveNotCome) {
    const ToldAgent agent;
    PeerModel peer = peerOf(agent);
    peer.add(agent.presence);
    EXPECT_EQ(peer.missingTypes(), agent.presence.types);
    EXPECT_EQ(peer.missingNames(), std::vector<std::string>{}) << "nothing names one yet";
    for (const Model& model : agent.models) {
        if (!model.simplexes.empty()) peer.add(model);
    }
    const auto names = peer.missingNames();
    EXPECT_FALSE(names.empty());
    EXPECT_LE(names.size(), PeerModel::mostNames);
    for (const std::string& each : names) {
        EXPECT_TRUE(std::ranges::any_of(agent.models, [&](const Model& model) {
            return std::ranges::find(model.types, each, &TypeMessage::name) != model.types.end();
        })) << each;
    }
    for (const Model& model : agent.models) peer.add(model);
    EXPECT_EQ(peer.missingNames(), std::vector<std::string>{});
    EXPECT_EQ(peer.missingTypes(), 0U);
}

TEST(PeerModel, IsIncompleteWhileAHashDiffers) {
    ToldAgent agent;
    agent.presence.structureHash[3] ^= 1U;
    PeerModel peer = peerOf(agent);

    tell(agent, peer);

    EXPECT_EQ(peer.missing(), 0U);
    EXPECT_FALSE(peer.complete());
    EXPECT_EQ(peer.structure(), nullptr);
    agent.presence.structureHash[3] ^= 1U;
    peer.add(agent.presence);
    EXPECT_NE(peer.structure(), nullptr);
}

TEST(PeerModel, MakesANewStructureOfChangedSamplesAndLeavesTheOldToItsReaders) {
    ToldAgent agent;
    PeerModel peer = peerOf(agent);
    tell(agent, peer);
    const auto before = peer.structure();
    tell(agent, peer);
    EXPECT_EQ(peer.structure(), before) << "repeats change nothing";

    agent.lie("/boss", [](SimplexMessage& boss) { boss.every = 8; });
    tell(agent, peer);

    const auto after = peer.structure();
    ASSERT_TRUE(after);
    EXPECT_NE(after, before);
    EXPECT_EQ(after->simplexes[after->find("/boss")].every, 8U);
    EXPECT_EQ(before->simplexes[before->find("/boss")].every, 4U);
}

TEST(PeerModel, IsCompleteWithNothingForATool) {
    Presence presence;
    presence.name = "tool";
    presence.agent = agentId("tool");
    presence.epoch = 7;
    presence.role = "tool";
    PeerModel peer{"tool", 7};

    EXPECT_TRUE(peer.add(presence));

    EXPECT_TRUE(peer.complete());
    EXPECT_EQ(peer.structure(), nullptr);
    EXPECT_TRUE(peer.findings().ok());
}

TEST(PeerModel, RefusesAndCountsWhatIsNotOfThisAgent) {
    const ToldAgent agent;
    const Model& good = agent.models.front();
    const std::vector<std::function<void(Model&)>> faults{
        [](Model& model) { model.agent = "other"; }, [](Model& model) { ++model.epoch; },
        [](Model& model) { model.id[0] ^= 1U; }, [](Model& model) { model.simplexes.resize(1); },
        [](Model& model) { model.types.clear(); }};
    PeerModel peer = peerOf(agent);
    for (const auto& fault : faults) {
        Model wrong = good;
        fault(wrong);
        EXPECT_FALSE(peer.add(wrong));
    }
    EXPECT_EQ(peer.refused(), faults.size());

    Presence wrong = agent.presence;
    wrong.agent[0] ^= 1U;
    EXPECT_FALSE(peer.add(wrong));
    wrong = agent.presence;
    wrong.simplexes = 0xffffffffU;
    EXPECT_FALSE(peer.add(wrong));
    wrong = agent.presence;
    --wrong.epoch;
    EXPECT_FALSE(peer.add(wrong));
    EXPECT_EQ(peer.refused(), faults.size() + 3);
    tell(agent, peer);
    EXPECT_TRUE(peer.complete());
}

TEST(PeerModel, RefusesPathsThatCannotBe) {
    ToldAgent agent;
    agent.lie("/plate", [](SimplexMessage& plate) { plate.path = "/a b"; });
    PeerModel peer = peerOf(agent);

    tell(agent, peer);

    EXPECT_EQ(peer.refused(), 1U);
    EXPECT_EQ(peer.missing(), 1U);
}

TEST(PeerModel, BelievesNoTypeThatIsNotWhatItsHashSays) {
    ToldAgent agent;
    agent.lie("Reading", [](TypeMessage& type) { type.data.front().length = 7; });

    EXPECT_TRUE(contains(refusal(agent), "Reading")) << refusal(agent);
}

TEST(PeerModel, FindsWhatASimplexSaysThatItsTypeDoesNotAllow) {
    using Lie = std::function<void(SimplexMessage&)>;
    const std::vector<std::pair<std::string, Lie>> lies{
        {"/boss", [](SimplexMessage& it) { it.index = 1; }},
        {"/boss", [](SimplexMessage& it) { it.role = "observation"; }},
        {"/boss", [](SimplexMessage& it) { it.every = 0; }},
        {"/boss", [](SimplexMessage& it) { it.every = 0xffffffffU; }},
        {"/boss", [](SimplexMessage& it) { it.phase = 4; }},
        {"/boss", [](SimplexMessage& it) { it.type = "Chief"; }},
        {"/boss", [](SimplexMessage& it) { it.typeHash[0] ^= 1U; }},
        {"/boss", [](SimplexMessage& it) { it.type = "Active"; }},
        {"/boss", [](SimplexMessage& it) { it.relationships[0].rule = "friends"; }},
        {"/boss", [](SimplexMessage& it) { it.relationships[0].target = "/nobody"; }},
        {"/boss", [](SimplexMessage& it) { it.relationships[0].remote = true; }},
        {"/reading", [](SimplexMessage& it) { it.constants[0].floats.pop_back(); }},
        {"/reading", [](SimplexMessage& it) { it.constants[0].kind = "int"; }},
        {"/reading", [](SimplexMessage& it) { it.constants[0].name = "a"; }},
        {"/reading", [](SimplexMessage& it) { it.constants[0].ints = {1}; }}};
    for (std::size_t i = 0; i < lies.size(); ++i) {
        ToldAgent agent;
        agent.lie(lies[i].first, lies[i].second);
        EXPECT_TRUE(contains(refusal(agent), lies[i].first)) << i << ": " << refusal(agent);
    }
}

TEST(TypeMessages, CarryEveryShippedTypeUnchanged) {
    const TypeModel model = TypeModel::load(CORTEX_SOURCE_DIR "/ontology/cortex-morphology.xml");
    std::vector<TypeDescription> received;
    for (const auto& [name, type] : model.types()) {
        received.push_back(typeDescription(typeMessage(describe(type))));
    }

    Report report;
    const TypeModel made = modelOf(received, report);

    EXPECT_TRUE(report.ok()) << report.text();
    ASSERT_EQ(made.types().size(), model.types().size());
    for (const auto& [name, type] : model.types()) {
        EXPECT_EQ(typeHash(made.at(name)), typeHash(type)) << name;
        for (const DataItem& item : type.data) {
            EXPECT_EQ(made.at(name).findData(item.name)->description, item.description);
        }
    }
}

TEST(NamedValues, AreReadBackAsTheyWere) {
    const std::map<std::string, Value> values{{"a", std::vector<std::int64_t>{1, -2}},
                                              {"b", std::vector{0.5}},
                                              {"c", std::vector<bool>{true, false}},
                                              {"d", std::vector<std::string>{"x y", ""}}};

    EXPECT_EQ(valuesOf(namedValues(values)), values);
}

TEST(NamedValues, RefuseMixedKindsAndRepeatedNames) {
    NamedValue value = namedValue("a", std::vector{0.5});
    EXPECT_FALSE(valuesOf({value, value}));
    value.ints.push_back(1);
    EXPECT_FALSE(valueOf(value));
    value = namedValue("a", std::vector{0.5});
    value.kind = "double";
    EXPECT_FALSE(valueOf(value));
}

}  // namespace
}  // namespace cortex::comms
