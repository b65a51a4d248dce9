// SPDX-License-Identifier: Apache-2.0
#include "cortex/core/simplex.hpp"

#include "cortex/core/agent.hpp"
#include "cortex/core/error.hpp"

#include "core/model_folder.hpp"

#include <memory>
#include <string>
#include <type_traits>

#include <gtest/gtest.h>

namespace cortex {
namespace {

static_assert(
    std::is_same_v<decltype(std::declval<InputSimplex>().data<double>("")), Data<const double>>);
static_assert(std::is_same_v<decltype(std::declval<InputSimplex>().array<double>("")),
                             std::span<const double>>);
static_assert(
    std::is_same_v<decltype(std::declval<OutputSimplex>().data<double>("")), Data<double>>);

template <class T>
concept HasArray = requires(const InputSimplex& simplex) { simplex.array<T>(""); };
static_assert(HasArray<bool> && HasArray<std::string_view>);
// No handle to another simplex's items that can be written.
template <class T>
concept GivesData = requires(T simplex) { simplex.template data<double>(""); };
static_assert(GivesData<Simplex&>);
static_assert(!GivesData<decltype(std::declval<RelatedSimplex>().simplex())>);

constexpr const char* ontology = R"(<ontology name="handles" version="1.0">
  <include file="base.xml"/>
  <type name="Axis" extends="Concept">
    <data name="position" kind="float" default="0.5" safe="hold"/>
    <data name="torques" kind="float" length="3" default="1 2 3" safe="hold"/>
    <data name="mode" kind="int" default="7" safe="hold"/>
    <data name="label" kind="string" capacity="8" safe="hold"/>
    <data name="names" kind="string" length="2" capacity="8" safe="hold"/>
    <data name="reach" kind="float" unit="mm" safe="hold"/>
    <data name="origin" kind="float" length="3" constant="true"/>
  </type>
  <type name="Mover" extends="Active"/>
  <type name="Worker" extends="Mover">
    <data name="gain" kind="float" default="1"/>
    <command name="zero">
      <request name="speed" kind="float"/><request name="points" kind="float" length="2"/>
      <response name="error" kind="float"/>
    </command>
  </type>
</ontology>)";

constexpr const char* morphology = R"(<morphology name="handles">
  <include file="base-morphology.xml"/><include file="types.xml"/>
  <rules type="Mover">
    <relationship name="axes" direction="output" target="Axis"/>
  </rules>
  <rules type="Worker">
    <relationship name="tip" direction="output" target="Axis" refines="axes" max="1"/>
    <relationship name="seen" direction="input" target="Axis"/>
    <relationship name="peers" direction="input" target="Worker" delayed="true"/>
    <relationship name="orders" direction="output" target="Worker"/>
  </rules>
</morphology>)";

class Worker : public Simplex {
public:
    using Simplex::argument;
    using Simplex::handle;
    using Simplex::input;
    using Simplex::inputs;
    using Simplex::output;
    using Simplex::outputs;
    using Simplex::result;
    using Simplex::Simplex;
};

TypeModel handleTypes() {
    const test::ModelFolder folder;
    folder.write("types.xml", ontology);
    return TypeModel::load(folder.write("rules.xml", morphology));
}

template <class Action>
std::string errorOf(Action action) {
    try {
        action();
    } catch (const Error& error) {
        return error.what();
    }
    return "no error";
}

// /worker writes /axis1 and, as its tip, /axis2; it sees /free; /worker and /peer know each other.
class SimplexTest : public ::testing::Test {
protected:
    SimplexTest() {
        tree.relate(worker, "axes", tree.add("/axis1", "Axis"));
        tree.relate(worker, "tip", tree.add("/axis2", "Axis"));
        tree.relate(worker, "seen", tree.add("/free", "Axis"));
        tree.relate(worker, "orders", peer);
        tree.relate(peer, "peers", worker);
    }
    void start() { runtime = std::make_unique<AgentRuntime>("robot", tree, AgentOptions{}); }

    SimplexTree tree{handleTypes()};
    Worker& worker = tree.add<Worker>("/worker", "Worker");
    Worker& peer = tree.add<Worker>("/peer", "Worker");
    std::unique_ptr<AgentRuntime> runtime;
};

TEST_F(SimplexTest, HasItsDataFromTheStartOn) {
    EXPECT_EQ(errorOf([&] { worker.data<double>("gain"); }),
              "/worker: data and relationships exist from populate() on");
    EXPECT_THROW(worker.slot(), Error);
    EXPECT_THROW(worker.inputs("seen"), Error);
    start();
    EXPECT_EQ(worker.data<double>("gain").get(), 1);
    EXPECT_EQ(worker.slot().quality, Quality::Good);
}

TEST_F(SimplexTest, StartsWithWhatWasSetLast) {
    worker.set("gain", 3);
    worker.set("gain", 4);
    Simplex& free = tree.at("/free");
    free.set("label", "left");
    free.set("mode", std::int64_t{9});
    free.set("torques", Value{std::vector{4.0, 5.0, 6.0}});
    start();

    EXPECT_EQ(worker.settings().size(), 1U);
    EXPECT_EQ(worker.data<double>("gain").get(), 4);
    EXPECT_EQ(free.data<std::string_view>("label").get(), "left");
    EXPECT_EQ(free.data<std::int64_t>("mode").get(), 9);
    EXPECT_EQ(free.array<double>("torques")[2], 6);
}

TEST_F(SimplexTest, IsWrittenThroughOutputsAndSeenThroughInputs) {
    start();
    Data<double> demand = worker.output("tip").data<double>("position");
    std::span<double> torques = worker.output("tip").array<double>("torques");
    const auto program = tree.at("/axis2").data<const double>("position");

    demand = 2.5;
    torques[1] = 8;

    EXPECT_EQ(program.get(), 2.5);
    EXPECT_EQ(tree.at("/axis2").array<const double>("torques")[1], 8);
    tree.at("/free").data<double>("position") = 0.25;
    EXPECT_EQ(worker.input("seen").data<double>("position").get(), 0.25);
    EXPECT_EQ(worker.input("seen").array<double>("torques").size(), 3U);
}

TEST_F(SimplexTest, KnowsWhatItIsRelatedTo) {
    start();
    const InputSimplex seen = worker.input("seen");

    EXPECT_EQ(seen.path(), "/free");
    EXPECT_EQ(seen.type().name, "Axis");
    EXPECT_TRUE(seen.has("position"));
    EXPECT_FALSE(seen.has("velocity"));
    EXPECT_EQ(&seen.state(), &tree.at("/free").slot());
}

TEST_F(SimplexTest, CountsWhatRefinesARuleForIt) {
    start();
    const auto axes = worker.outputs("axes");

    ASSERT_EQ(axes.size(), 2U);
    EXPECT_EQ(axes[0].path(), "/axis1");
    EXPECT_EQ(axes[1].path(), "/axis2");
    EXPECT_EQ(worker.outputs("tip").size(), 1U);
}

TEST_F(SimplexTest, ReadsALatchThroughADelayedRelationship) {
    start();
    const auto gain = peer.input("peers").data<double>("gain");

    worker.data<double>("gain") = 5;
    EXPECT_EQ(gain.get(), 1);
    runtime->tables().latch();
    EXPECT_EQ(gain.get(), 5);
}

TEST_F(SimplexTest, LeavesDataOfActiveSimplexesToTheirTask) {
    start();
    const OutputSimplex order = worker.output("orders");

    EXPECT_EQ(order.data<const double>("gain").get(), 1);
    EXPECT_EQ(errorOf([&] { order.data<double>("gain"); }),
              "/worker: /peer.gain is written by its own task only: take a handle to const, or "
              "send a command");
}

TEST_F(SimplexTest, LeavesAWrittenConceptToItsWriter) {
    start();
    Simplex& axis = tree.at("/axis1");

    EXPECT_EQ(axis.data<const double>("position").get(), 0.5);
    EXPECT_EQ(errorOf([&] { axis.data<double>("position"); }),
              "/axis1.position is written by /worker");
}

TEST_F(SimplexTest, KeepsConstantsConstant) {
    tree.at("/free").set("origin", Value{std::vector{1.0, 2.0, 3.0}});
    start();

    EXPECT_EQ(worker.input("seen").array<double>("origin")[2], 3);
    EXPECT_EQ(tree.at("/free").array<const double>("origin")[0], 1);
    EXPECT_EQ(errorOf([&] { tree.at("/free").array<double>("origin"); }),
              "/free.origin is constant: take a handle to const");
    EXPECT_THROW(worker.output("tip").array<double>("origin"), Error);
}

TEST_F(SimplexTest, RefusesHandlesThatDoNotFitAndNamesWhatIsThere) {
    start();
    const InputSimplex seen = worker.input("seen");

    EXPECT_EQ(errorOf([&] { seen.data<double>("positon"); }),
              "/free: type Axis has no item 'positon'; nearest of: position");
    EXPECT_EQ(errorOf([&] { seen.data<double>("mode"); }),
              "/worker: /free.mode is int: reading one float does not fit; take data<…>() or "
              "array<…>() of its kind");
    EXPECT_EQ(errorOf([&] { worker.output("tip").data<double>("torques"); }),
              "/worker: /axis2.torques is float array of 3: writing one float does not fit; take "
              "data<…>() or array<…>() of its kind");
    EXPECT_THROW(tree.at("/free").data<std::string_view>("names"), Error);
    EXPECT_EQ(seen.array<double>("position").size(), 1U);
}

TEST_F(SimplexTest, RefusesTheUnitThatTheTypeDoesNotState) {
    start();
    const InputSimplex seen = worker.input("seen");

    EXPECT_EQ(seen.data<double>("reach", "mm").get(), 0);
    const std::string refusal = errorOf([&] { seen.data<double>("reach", "m"); });
    EXPECT_EQ(refusal.find("/worker: /free.reach is in mm, the code assumes m: convert in the "
                           "code, or state that unit in the type ["),
              0U)
        << refusal;
    EXPECT_NE(refusal.find("types.xml:"), std::string::npos) << refusal;
    EXPECT_NE(errorOf([&] {
                  worker.data<double>("gain", "m");
              }).find("/worker.gain is in no stated unit, the code assumes m"),
              std::string::npos);
    EXPECT_NE(errorOf([&] {
                  worker.output("tip").data<double>("reach", "metre");
              }).find("the code assumes the unit 'metre'"),
              std::string::npos);
}

TEST_F(SimplexTest, ReadsAndWritesArraysOfStrings) {
    tree.at("/free").set("names", Value{std::vector<std::string>{"left", "right"}});
    start();
    const TextArray<const std::string_view> seen =
        worker.input("seen").array<std::string_view>("names");
    const TextArray<std::string_view> own = tree.at("/free").array<std::string_view>("names");

    own[0] = "middle";
    EXPECT_EQ(seen[0].get(), "middle");
    EXPECT_EQ(seen[1].get(), "right");
    own[0] = own[1];  // the value, though neither handle has a name
    EXPECT_EQ(seen[0].get(), "right");
    EXPECT_EQ(seen.size(), 2U);
    EXPECT_THROW(worker.input("seen").array<std::string_view>("torques"), Error);
}

TEST_F(SimplexTest, LeavesWhatTheFrameworkWritesToIt) {
    start();

    EXPECT_EQ(worker.data<const std::int64_t>("faultCode").get(), 0);
    EXPECT_EQ(errorOf([&] { worker.data<std::int64_t>("faultCode"); }),
              "/worker.faultCode is written by the framework: take a handle to const");
    EXPECT_THROW(worker.data<std::int64_t>("state"), Error);
    EXPECT_THROW(worker.data<std::string_view>("faultText"), Error);
    EXPECT_THROW(worker.data<double>("taskTime"), Error);
    EXPECT_THROW(tree.at("/robot").array<std::string_view>("leaseHolder"), Error);
}

TEST_F(SimplexTest, RefusesRulesThatDoNotFitAndNamesWhatIsThere) {
    start();

    EXPECT_EQ(errorOf([&] { worker.inputs("sen"); }),
              "/worker: type Worker has no rule 'sen'; nearest of: seen");
    EXPECT_EQ(errorOf([&] { worker.input("axes"); }),
              "/worker: rule 'axes' is an output; ask output() or outputs()");
    EXPECT_EQ(errorOf([&] { worker.output("axes"); }),
              "/worker: rule 'axes' relates 2 simplexes, not one; ask outputs()");
    EXPECT_EQ(errorOf([&] { peer.input("seen"); }),
              "/peer: rule 'seen' relates 0 simplexes, not one; ask inputs()");
}

TEST_F(SimplexTest, FindsTheParametersOfItsCommands) {
    start();

    EXPECT_EQ(worker.argument<double>("zero", "speed").offset, 0U);
    EXPECT_EQ(worker.result<double>("zero", "error").offset, 0U);
    EXPECT_EQ(errorOf([&] { worker.argument<double>("zeros", "speed"); }),
              "/worker: type Worker has no command 'zeros'; nearest of: zero");
    EXPECT_EQ(errorOf([&] { worker.argument<double>("zero", "sped"); }),
              "/worker: request of command 'zero' has no 'sped'; nearest of: speed");
    EXPECT_EQ(errorOf([&] { worker.result<double>("zero", "speed"); }),
              "/worker: response of command 'zero' has no 'speed'; there is: error");
    EXPECT_THROW(worker.argument<bool>("zero", "speed"), Error);
}

TEST_F(SimplexTest, HandlesOnlyCommandsOfItsTypeThatAreItsOwn) {
    start();

    worker.handle("zero", Handler{&worker, [](void*, Call&) { return Outcome::Done; }});
    EXPECT_EQ(errorOf([&] { worker.handle("zeo", Handler{}); }),
              "/worker: type Worker has no command 'zeo'; nearest of: zero");
    EXPECT_EQ(errorOf([&] { worker.handle("startup", Handler{}); }),
              "/worker: 'startup' is carried out by the framework");
}

TEST_F(SimplexTest, SendsCommandsAlongItsRelationships) {
    start();
    EXPECT_TRUE(worker.output("orders").command("zero").bound());
    EXPECT_TRUE(peer.input("peers").command("zero", 4).bound());
    EXPECT_THROW(worker.output("orders").command("none"), Error);
}

TEST_F(SimplexTest, RefusesARateThatCannotBe) {
    worker.runEvery(4, 3);
    EXPECT_EQ(worker.every(), 4);
    EXPECT_EQ(worker.phase(), 3);
    EXPECT_THROW(worker.runEvery(0), Error);
    EXPECT_THROW(worker.runEvery(2, 2), Error);
    EXPECT_THROW(worker.runEvery(2, -2), Error);
}

TEST(SimplexSetting, TakesTextAsText) {
    SimplexTree tree{handleTypes()};
    Simplex& axis = tree.add("/axis", "Axis");
    axis.set("label", "left");
    axis.set("mode", true);

    EXPECT_EQ(axis.settings()[0].value, Value{std::vector<std::string>{"left"}});
    EXPECT_EQ(axis.settings()[1].value, Value{std::vector<bool>{true}});
}

}  // namespace
}  // namespace cortex
