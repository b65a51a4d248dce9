// SPDX-License-Identifier: Apache-2.0
#include "core/xml_model.hpp"

#include <gtest/gtest.h>

// What types say about relationships: alone, narrowed by children, and joined from several parents.
namespace cortex {
namespace {

using test::finds;
using test::isValid;
using test::readTypes;
using test::XmlModel;

const std::string types = R"(<type name="Concept" role="descriptive" abstract="true"/>
<type name="Axis" extends="Concept"/> <type name="Rotary" extends="Axis"/> <type name="Linear" extends="Axis"/>
<type name="RotaryLinear" extends="Rotary Linear"/>
<type name="P" role="active"/> <type name="Q" role="active"/> <type name="A" extends="P"/> <type name="B" extends="P Q"/>
)";

// Rules of P, A (its child), Q and B (child of P and Q); each on a line of its own from line 2.
XmlModel rules(const std::string& p, const std::string& a = "", const std::string& q = "",
               const std::string& b = "") {
    std::string text;
    const auto add = [&](const char* type, const std::string& relationships) {
        if (!relationships.empty()) {
            text += std::string{"\n<rules type='"} + type + "'>" + relationships + "</rules>";
        }
    };
    add("P", p);
    add("A", a);
    add("Q", q);
    add("B", b);
    return readTypes(types, text);
}

std::string rule(const std::string& attributes, const std::string& name = "r") {
    return "<relationship name='" + name + "' " + attributes + "/>";
}

TEST(Rule, ReadsEveryAttribute) {
    const XmlModel model = rules(
        rule("direction='output' target='Axis' min='2' max='7' create='Axis Rotary' delayed='true' "
             "counterpart='seen' description='d'") +
        "<relationship name='seen' direction='input' target='Axis' onLoss='hold' maxAge='0.2'>"
        "<description>long</description></relationship>");
    ASSERT_TRUE(isValid(model));
    const Rule& r = model.rule("A", "r");
    EXPECT_EQ(r.direction, Direction::Output);
    EXPECT_EQ(r.target, "Axis");
    EXPECT_EQ(r.min, 2U);
    EXPECT_EQ(r.max, 7U);
    EXPECT_EQ(r.create, (std::vector<std::string>{"Axis", "Rotary"}));
    EXPECT_TRUE(r.delayed);
    EXPECT_EQ(r.counterpart, "seen");
    EXPECT_EQ(r.definedBy, "P");
    EXPECT_EQ(r.place.line, 2);
    const Rule& seen = model.rule("P", "seen");
    EXPECT_EQ(seen.onLoss, OnLoss::Hold);
    EXPECT_EQ(seen.maxAge, 0.2);
    EXPECT_EQ(seen.max, Rule::many);
    EXPECT_EQ(seen.description, "long");
}

TEST(Rule, NeedsDirectionAndTarget) {
    EXPECT_TRUE(finds(rules(rule("target='Axis'")), "direction-missing", "P", 2));
    EXPECT_TRUE(finds(rules(rule("direction='input'")), "target-missing", "P", 2));
}

TEST(Rule, NamesKnownTypes) {
    EXPECT_TRUE(finds(rules(rule("direction='input' target='Axs'")), "unknown-target", "P", 2,
                      "nearest of: Axis"));
    EXPECT_TRUE(finds(rules(rule("direction='input' target='Quuux'")), "unknown-target", "P", 2,
                      "include"));
    EXPECT_TRUE(finds(rules(rule("direction='input' target='Axis' create='Rotry'")),
                      "unknown-create", "P", 2, "Rotary"));
    EXPECT_TRUE(finds(rules(rule("direction='input' target='Axis' create='Quuux'")),
                      "unknown-create", "P", 2));
    EXPECT_TRUE(finds(readTypes(types, "\n<rules type='Axs'/>"), "unknown-type", "Axs", 2,
                      "nearest of: Axis"));
    EXPECT_TRUE(
        finds(readTypes(types, "\n<rules type='Quuux'/>"), "unknown-type", "Quuux", 2, "include"));
}

TEST(Rule, CreatesOnlyWhatMayBeRelated) {
    EXPECT_TRUE(finds(rules(rule("direction='input' target='Rotary' create='Linear'")),
                      "create-target", "P", 2));
    EXPECT_TRUE(finds(rules(rule("direction='input' target='Concept' create='Concept'")),
                      "create-abstract", "P", 2));
    EXPECT_TRUE(
        finds(rules(rule("direction='input' target='Axis' create='Axis'"), rule("target='Rotary'")),
              "create-target", "A", 3, "restate create"));
}

TEST(Rule, IsGivenOncePerType) {
    EXPECT_TRUE(finds(rules(rule("direction='input' target='Axis'") + "\n" +
                            rule("direction='input' target='Axis'")),
                      "duplicate-rule", "P", 3, "first at m.xml:2"));
}

TEST(Rule, HasACountThatCanBeMet) {
    EXPECT_TRUE(finds(rules(rule("direction='input' target='Axis' min='2' max='1'")), "count-empty",
                      "P", 2));
    EXPECT_TRUE(
        finds(rules(rule("direction='input' target='Axis' max='0'")), "count-empty", "P", 2));
    EXPECT_TRUE(finds(rules(rule("direction='input' target='Axis' max='-1'")), "attribute-value",
                      "P", 2, "or *"));
    EXPECT_TRUE(
        finds(rules(rule("direction='input' target='Axis' min='*'")), "attribute-value", "P", 2));
}

TEST(Rule, HasLossAndAgeOnlyAsInput) {
    EXPECT_TRUE(finds(rules(rule("direction='output' target='Axis' onLoss='hold'")),
                      "on-loss-direction", "P", 2));
    EXPECT_TRUE(finds(rules(rule("direction='output' target='Axis' maxAge='1'")),
                      "on-loss-direction", "P", 2));
    EXPECT_TRUE(
        finds(rules(rule("direction='input' target='Axis' maxAge='0'")), "max-age", "P", 2));
}

TEST(Rule, HasASecondRuleThatCanHaveAsMany) {
    const std::string in = rule("direction='input' target='Axis' min='2' max='3'", "seen");
    const auto out = [&](const std::string& attributes) {
        return rules(in + rule("direction='output' target='Axis' " + attributes));
    };
    EXPECT_EQ(out("sameCount='seen'").rule("A", "r").sameCount, "seen");
    EXPECT_TRUE(isValid(out("sameCount='seen' min='3'")));
    EXPECT_TRUE(finds(out("sameCount='sen'"), "same-count", "P", 2, "nearest of: seen"));
    EXPECT_TRUE(finds(out("sameCount='r'"), "same-count", "P", 2, "which is itself"));
    EXPECT_TRUE(finds(out("sameCount='seen' min='4'"), "same-count", "P", 2, "4 to * "));
    EXPECT_TRUE(finds(out("sameCount='seen' max='1'"), "same-count", "P", 2, "2 to 3"));
}

TEST(Rule, KeepsTheSameCountThatItInherits) {
    const std::string in = "direction='input' target='Axis'";
    const std::string both = rule(in, "seen") + rule(in, "other") + rule(in + " sameCount='seen'");
    EXPECT_EQ(rules(both, rule("max='3'")).rule("A", "r").sameCount, "seen");
    EXPECT_TRUE(finds(rules(both, rule("sameCount='other'")), "same-count", "A", 3,
                      "changes the inherited sameCount"));
}

TEST(Rule, HasAnInputRuleAsCounterpart) {
    const std::string in = rule("direction='input' target='Axis'", "seen");
    EXPECT_TRUE(isValid(rules(in + rule("direction='output' target='Axis' counterpart='seen'"))));
    EXPECT_TRUE(finds(rules(in + rule("direction='output' target='Axis' counterpart='sen'")),
                      "counterpart", "P", 2, "nearest of: seen"));
    EXPECT_TRUE(finds(rules(in + rule("direction='output' target='Axis' counterpart='quuux'")),
                      "counterpart", "P", 2, "valid: r, seen"));
    EXPECT_TRUE(finds(rules(in + rule("direction='input' target='Axis' counterpart='seen'")),
                      "counterpart", "P", 2, "but is no output"));
    EXPECT_TRUE(finds(rules(rule("direction='output' target='Axis' counterpart='r'")),
                      "counterpart", "P", 2, "which is no input"));
}

// refines

TEST(Refines, NamesAnInheritedRuleOfItsDirectionAndTarget) {
    const std::string outputs = rule("direction='output' target='Axis' min='1' max='4'", "outputs");
    const XmlModel model =
        rules(outputs, rule("direction='output' target='Rotary' max='1' refines='outputs'", "tip"));
    ASSERT_TRUE(isValid(model));
    EXPECT_EQ(model.rule("A", "tip").refines, "outputs");
    EXPECT_TRUE(
        finds(rules(outputs, rule("direction='output' target='Axis' refines='output'", "tip")),
              "refines", "A", 3, "nearest of: outputs"));
    EXPECT_TRUE(
        finds(rules(outputs, rule("direction='input' target='Axis' refines='outputs'", "tip")),
              "refines", "A", 3, "which is an output"));
    EXPECT_TRUE(
        finds(rules(outputs, rule("direction='output' target='Concept' refines='outputs'", "tip")),
              "refines", "A", 3, "whose target"));
    EXPECT_TRUE(finds(
        rules(outputs, rule("direction='output' target='Axis' min='5' refines='outputs'", "tip")),
        "refines", "A", 3, "write a min of at most 4"));
}

TEST(Refines, ADelayedRuleIsRefinedByADelayedOneOnly) {
    const std::string outputs = rule("direction='output' target='Axis' delayed='true'", "outputs");
    const std::string tip = "direction='output' target='Rotary' refines='outputs'";
    EXPECT_TRUE(isValid(rules(outputs, rule(tip + " delayed='true'", "tip"))));
    EXPECT_TRUE(finds(rules(outputs, rule(tip, "tip")), "refines", "A", 3, "which is delayed"));
}

TEST(Refines, IsNotForRulesOfTheSameType) {
    const std::string both = rule("direction='output' target='Axis'", "outputs") +
                             rule("direction='output' target='Axis' refines='outputs'", "tip");
    EXPECT_TRUE(finds(rules(both), "refines", "P", 2, "which is no inherited rule"));
}

TEST(Refines, DoesNotLeadBackToItself) {
    const std::string two = rule("direction='input' target='Axis'", "one") +
                            rule("direction='input' target='Axis'", "two");
    const XmlModel model =
        rules(two, rule("refines='two'", "one") + "\n" + rule("refines='one'", "two"));
    ASSERT_EQ(model.report.findings.size(), 2U) << model.text();
    EXPECT_EQ(model.report.findings[0].rule, "refines");
    EXPECT_NE(model.text().find("leads back to itself"), std::string::npos);
}

// Narrowing

TEST(RuleNarrowing, KeepsWhatIsNotStatedAndTightensTheRest) {
    const XmlModel model = rules(
        rule("direction='output' target='Axis' min='1' max='7' create='Axis'"),
        rule("target='Rotary' min='2' max='5' create='Rotary' delayed='true' description='d'"));
    ASSERT_TRUE(isValid(model));
    const Rule& r = model.rule("A", "r");
    EXPECT_EQ(r.direction, Direction::Output);
    EXPECT_EQ(r.target, "Rotary");
    EXPECT_EQ(r.min, 2U);
    EXPECT_EQ(r.max, 5U);
    EXPECT_TRUE(r.delayed);
    EXPECT_EQ(r.definedBy, "A");
    const XmlModel input =
        rules(rule("direction='input' target='Axis'"), rule("onLoss='safe' maxAge='0.01'"));
    ASSERT_TRUE(isValid(input));
    EXPECT_EQ(input.rule("A", "r").onLoss, OnLoss::Safe);
    EXPECT_EQ(input.rule("A", "r").maxAge, 0.01);
}

TEST(RuleNarrowing, NeverWidensOrTurns) {
    const std::string inherited =
        rule("direction='output' target='Rotary' min='2' max='3' delayed='true'");
    EXPECT_TRUE(finds(rules(inherited, rule("direction='input'")), "direction-changed", "A", 3));
    EXPECT_TRUE(finds(rules(inherited, rule("target='Axis'")), "target-widened", "A", 3,
                      "write target=\"Rotary\""));
    EXPECT_TRUE(finds(rules(inherited, rule("target='Linear'")), "target-widened", "A", 3));
    EXPECT_TRUE(
        finds(rules(inherited, rule("min='1'")), "count-widened", "A", 3, "write min=\"2\""));
    EXPECT_TRUE(
        finds(rules(inherited, rule("max='*'")), "count-widened", "A", 3, "write max=\"3\""));
    EXPECT_TRUE(finds(rules(inherited, rule("delayed='false'")), "delayed-loosened", "A", 3));
}

// Several parents

TEST(RuleIntersection, TakesTheMostDerivedTargetAndTheTighterCounts) {
    const XmlModel model = rules(rule("direction='input' target='Axis' min='1' max='7' "
                                      "onLoss='hold' maxAge='0.02' create='Rotary'"),
                                 "",
                                 rule("direction='input' target='Rotary' max='4' onLoss='hold' "
                                      "delayed='true' description='q'"));
    ASSERT_TRUE(isValid(model));
    const Rule& r = model.rule("B", "r");
    EXPECT_EQ(r.target, "Rotary");
    EXPECT_EQ(r.min, 1U);
    EXPECT_EQ(r.max, 4U);
    EXPECT_TRUE(r.delayed);
    EXPECT_EQ(r.maxAge, 0.02);
    EXPECT_EQ(r.create, std::vector<std::string>{"Rotary"});
    EXPECT_EQ(r.description, "q");
}

TEST(RuleIntersection, ThatIsEmptyNamesBothParents) {
    const auto joined = [](const std::string& p, const std::string& q) {
        return rules(rule(p), "", rule(q));
    };
    EXPECT_TRUE(finds(joined("direction='input' target='Axis' max='1'",
                             "direction='input' target='Axis' min='2'"),
                      "intersection-empty", "B", 4,
                      "count '0 to 1' from 'P' and '2 to *' from 'Q'"));
    EXPECT_TRUE(finds(joined("direction='input' target='Axis'", "direction='output' target='Axis'"),
                      "intersection-empty", "B", 4,
                      "direction 'input' from 'P' and 'output' from 'Q'"));
    EXPECT_TRUE(
        finds(joined("direction='input' target='Rotary'", "direction='input' target='Linear'"),
              "intersection-empty", "B", 4, "target 'Rotary' from 'P' and 'Linear' from 'Q'"));
}

TEST(RuleIntersection, IsSettledByAChildThatFitsBothParents) {
    EXPECT_TRUE(
        isValid(rules(rule("direction='input' target='Rotary'"), "",
                      rule("direction='input' target='Linear'"), rule("target='RotaryLinear'"))));
    const std::string p =
        rule("direction='input' target='Axis' create='Rotary' onLoss='hold' max='4'");
    const std::string q = rule("direction='input' target='Axis' create='Linear' onLoss='safe'");
    const XmlModel open = rules(p, "", q);
    ASSERT_EQ(open.report.findings.size(), 2U) << open.text();
    EXPECT_EQ(open.report.findings[0].rule, "restate");
    EXPECT_TRUE(isValid(rules(p, "", q, rule("create='RotaryLinear' onLoss='fault'"))));
}

TEST(RuleIntersection, AsksForRefinesAndCounterpartThatDiffer) {
    const auto all = [](const std::string& type) {
        return rule("direction='input' target='Axis'", "in" + type) +
               rule("direction='input' target='Axis'", "other") +
               rule("direction='output' target='Axis' counterpart='in" + type + "'");
    };
    EXPECT_TRUE(finds(rules(all("P"), "", all("Q")), "restate", "B", 4, "counterpart='inP'"));
    EXPECT_TRUE(isValid(rules(all("P"), "", all("Q"), rule("counterpart='other'"))));
    EXPECT_EQ(
        rules(all("P"), "", rule("direction='output' target='Axis'")).rule("B", "r").counterpart,
        "inP");
    EXPECT_EQ(
        rules(rule("direction='output' target='Axis'"), "", all("Q")).rule("B", "r").counterpart,
        "inQ");
}

}  // namespace
}  // namespace cortex
