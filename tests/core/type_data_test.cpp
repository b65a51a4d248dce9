// SPDX-License-Identifier: Apache-2.0
#include "cortex/core/agreement.hpp"

#include "core/xml_model.hpp"

#include <gtest/gtest.h>

// What types say about data items: alone, narrowed by children, and joined from several parents.
namespace cortex {
namespace {

using test::finds;
using test::isValid;
using test::readTypes;
using test::XmlModel;

XmlModel item(const std::string& attributes) {
    return readTypes("<type name='A'>\n<data name='x' " + attributes + "/></type>");
}

XmlModel narrowed(const std::string& inherited, const std::string& own) {
    return readTypes("<type name='P'><data name='x' " + inherited +
                     "/></type>\n"
                     "<type name='A' extends='P'>\n<data name='x' " +
                     own + "/></type>");
}

XmlModel joined(const std::string& first, const std::string& second, const std::string& own = "") {
    const std::string child = own.empty() ? "" : "<data name='x' " + own + "/>";
    return readTypes("<type name='P'><data name='x' " + first +
                     "/></type>\n<type name='Q'><data name='x' " + second +
                     "/></type>\n<type name='A' extends='P Q'>" + child + "</type>");
}

TEST(DataItem, ReadsEveryAttribute) {
    const XmlModel model = item(
        "kind='float' length='2' unit='rad.s-1' min='-2' max='2.5' rate='3' "
        "default='0.5 1' description='speed' safe='0 0' onLimit='fault' "
        "settable='Standby Active' measured='true' resolution='0.01' "
        "deadband='0.1' format='%.3f'");
    ASSERT_TRUE(isValid(model));
    const DataItem& x = model.data("A", "x");
    EXPECT_EQ(x.kind, Kind::Float);
    EXPECT_EQ(x.length, 2U);
    EXPECT_EQ(x.unit, "rad/s");
    EXPECT_EQ(x.min, Number{-2.0});
    EXPECT_EQ(x.max, Number{2.5});
    EXPECT_EQ(x.rate, 3);
    EXPECT_EQ(x.initial, (Value{std::vector<double>{0.5, 1}}));
    EXPECT_EQ(x.safe, (Safe{Safe::Kind::Given, std::vector<double>{0, 0}}));
    EXPECT_EQ(x.onLimit, OnLimit::Fault);
    EXPECT_EQ(x.settable.text(), "Standby Active");
    EXPECT_TRUE(x.measured);
    EXPECT_EQ(x.resolution + x.deadband, 0.11);
    EXPECT_EQ(x.format + x.description, "%.3fspeed");
    EXPECT_EQ(x.definedBy, "A");
    EXPECT_EQ(x.place.line, 2);
}

TEST(DataItem, TakesItsDescriptionFromAnElementToo) {
    const XmlModel model = readTypes(
        "<type name='A'><data name='x' kind='int'><description>long text"
        "</description></data><description>the type</description></type>");
    ASSERT_TRUE(isValid(model));
    EXPECT_EQ(model.data("A", "x").description, "long text");
    EXPECT_EQ(model.type("A").description, "the type");
}

TEST(DataItem, StartsWithZeroMovedIntoItsRange) {
    EXPECT_EQ(item("kind='int' min='3'").data("A", "x").initial,
              Value{std::vector<std::int64_t>{3}});
    EXPECT_EQ(item("kind='float' max='-1.5'").data("A", "x").initial,
              Value{std::vector<double>{-1.5}});
    EXPECT_EQ(item("kind='int' labels='2:Two 5:Five'").data("A", "x").initial,
              Value{std::vector<std::int64_t>{2}});
    EXPECT_EQ(item("kind='bool' length='2'").data("A", "x").initial,
              (Value{std::vector<bool>{false, false}}));
    EXPECT_EQ(item("kind='string'").data("A", "x").initial, Value{std::vector<std::string>{""}});
    EXPECT_FALSE(item("kind='int'").data("A", "x").hasDefault);
}

TEST(DataItem, NeedsAKind) { EXPECT_TRUE(finds(item(""), "kind-missing", "A", 2, "write kind=")); }

TEST(DataItem, IsGivenOnce) {
    EXPECT_TRUE(finds(
        readTypes("<type name='A'><data name='x' kind='int'/>\n<data name='x' kind='int'/></type>"),
        "duplicate-data", "A", 2, "first at t.xml:1"));
}

TEST(DataItem, HasABoundedLengthAndCapacity) {
    EXPECT_TRUE(finds(item("kind='int' length='0'"), "length-bounds", "A", 2));
    EXPECT_TRUE(finds(item("kind='int' length='65537'"), "length-bounds", "A", 2));
    EXPECT_TRUE(isValid(item("kind='int' length='65536'")));
    EXPECT_TRUE(finds(item("kind='string' capacity='4097'"), "capacity-bounds", "A", 2));
    EXPECT_TRUE(finds(item("kind='string' capacity='0'"), "capacity-bounds", "A", 2));
    EXPECT_TRUE(finds(item("kind='int' capacity='8'"), "capacity-kind", "A", 2));
}

TEST(DataItem, HasAUnitOfUcumIfItIsANumber) {
    EXPECT_TRUE(finds(item("kind='float' unit='radians'"), "unit", "A", 2, "nearest of: rad"));
    EXPECT_TRUE(finds(item("kind='bool' unit='m'"), "unit-kind", "A", 2));
    EXPECT_TRUE(finds(item("kind='string' unit='m'"), "unit-kind", "A", 2));
}

TEST(DataItem, HasARangeOfItsKind) {
    EXPECT_TRUE(finds(item("kind='bool' min='0'"), "range-kind", "A", 2));
    EXPECT_TRUE(finds(item("kind='int' max='1.5'"), "range-kind", "A", 2, "whole number"));
    EXPECT_TRUE(finds(item("kind='int' max='99999999999999999999'"), "range-kind", "A", 2));
    EXPECT_TRUE(finds(item("kind='float' min='2' max='1'"), "range-empty", "A", 2, "2 to 1"));
    EXPECT_EQ(toText(*item("kind='float' min='-0.0'").data("A", "x").min), "0")
        << "a whole number, which is how another agent reads it";
    EXPECT_TRUE(finds(item("kind='float' min='nan'"), "attribute-value", "A", 2));
    EXPECT_TRUE(finds(item("kind='float' max='1e999'"), "attribute-value", "A", 2));
    EXPECT_TRUE(finds(item("kind='float' max='inf'"), "attribute-value", "A", 2));
}

TEST(DataItem, HasADefaultOfItsKindAndRange) {
    EXPECT_TRUE(finds(item("kind='float' default='abc'"), "default-kind", "A", 2, "found 'abc'"));
    EXPECT_TRUE(finds(item("kind='float' default='nan'"), "default-kind", "A", 2));
    EXPECT_TRUE(finds(item("kind='int' default='1.5'"), "default-kind", "A", 2));
    EXPECT_TRUE(finds(item("kind='bool' default='1'"), "default-kind", "A", 2));
    EXPECT_TRUE(finds(item("kind='int' length='3' default='1 2'"), "default-kind", "A", 2));
    EXPECT_TRUE(finds(item("kind='float' min='-1' max='1' default='2'"), "default-range", "A", 2,
                      "write default=\"0\""));
    EXPECT_TRUE(finds(item("kind='int' labels='0:A 1:B' default='7'"), "default-range", "A", 2));
    EXPECT_TRUE(finds(item("kind='string' capacity='3' default='four'"), "default-range", "A", 2));
    EXPECT_TRUE(isValid(item("kind='string' length='2' default='\"a b\" c'")));
}

TEST(DataItem, HasASafeValueOfItsKindAndRange) {
    EXPECT_TRUE(finds(item("kind='float' safe='none'"), "safe-kind", "A", 2));
    EXPECT_TRUE(
        finds(item("kind='float' max='1' safe='2'"), "safe-range", "A", 2, "safe for the plant"));
    EXPECT_EQ(item("kind='float' safe='observed'").data("A", "x").safe.kind, Safe::Kind::Observed);
    EXPECT_EQ(item("kind='bool' safe='hold'").data("A", "x").safe.kind, Safe::Kind::Hold);
}

TEST(DataItem, HasStepsAndRatesOnlyAsNumber) {
    EXPECT_TRUE(finds(item("kind='bool' resolution='1'"), "resolution", "A", 2));
    EXPECT_TRUE(finds(item("kind='float' deadband='-1'"), "resolution", "A", 2));
    EXPECT_TRUE(finds(item("kind='int' rate='1'"), "rate", "A", 2));
    EXPECT_TRUE(finds(item("kind='float' rate='0'"), "rate", "A", 2));
}

TEST(DataItem, HasLabelsOnlyAsInt) {
    EXPECT_TRUE(finds(item("kind='float' labels='0:A'"), "labels", "A", 2));
    EXPECT_TRUE(finds(item("kind='int' min='0' max='1' labels='0:A 2:B'"), "labels", "A", 2));
    EXPECT_TRUE(finds(item("kind='int' labels='0:A 1:-5'"), "labels", "A", 2, "a number, too"));
    for (const char* labels : {"", "A", "0", "0:", "x:A", "0:A 0:B", "0:A 1:A"}) {
        EXPECT_TRUE(finds(item("kind='int' labels='" + std::string{labels} + "'"),
                          "attribute-value", "A", 2))
            << labels;
    }
    std::string many;
    for (int i = 0; i < 1025; ++i) many += std::to_string(i) + ":L" + std::to_string(i) + " ";
    EXPECT_TRUE(finds(item("kind='int' labels='" + many + "'"), "attribute-value", "A", 2));
}

TEST(DataItem, IsNotSettableAndConstant) {
    EXPECT_TRUE(
        finds(item("kind='int' settable='always' constant='true'"), "settable-constant", "A", 2));
}

// Narrowing

TEST(Narrowing, KeepsWhatAChildDoesNotState) {
    const XmlModel model = narrowed(
        "kind='int' unit='ms' min='0' max='9' default='4' labels='4:Four' "
        "settable='always' safe='1' onLimit='fault' format='d'",
        "max='5'");
    ASSERT_TRUE(isValid(model));
    const DataItem& x = model.data("A", "x");
    EXPECT_EQ(x.kind, Kind::Int);
    EXPECT_EQ(x.min, Number{std::int64_t{0}});
    EXPECT_EQ(x.max, Number{std::int64_t{5}});
    EXPECT_EQ(x.initial, Value{std::vector<std::int64_t>{4}});
    EXPECT_EQ(x.labels.at(4), "Four");
    EXPECT_EQ(x.settable, StateSet::always());
    EXPECT_EQ(x.safe.value, Value{std::vector<std::int64_t>{1}});
    EXPECT_EQ(x.onLimit, OnLimit::Fault);
    EXPECT_EQ(x.definedBy, "A");
}

TEST(Narrowing, AllowsWhatIsTighter) {
    const XmlModel model =
        narrowed("kind='float' settable='Standby Active' rate='5'",
                 "min='0' rate='2' settable='Standby' safe='0' onLimit='fault' "
                 "default='1' resolution='0.1' deadband='0.2' format='f' unit='' "
                 "description='d' labels='0:A'");
    ASSERT_EQ(model.report.findings.size(), 1U);  // labels are for int
    const DataItem& x = model.data("A", "x");
    EXPECT_EQ(x.rate, 2);
    EXPECT_EQ(x.settable.text(), "Standby");
    EXPECT_EQ(x.resolution, 0.1);
    EXPECT_EQ(x.deadband, 0.2);
    EXPECT_EQ(x.format + x.description, "fd");
}

TEST(Narrowing, NeverChangesTheShape) {
    EXPECT_TRUE(finds(narrowed("kind='int'", "kind='float'"), "kind-changed", "A", 3,
                      "from 'int' to 'float'"));
    EXPECT_TRUE(finds(narrowed("kind='int'", "length='2'"), "length-changed", "A", 3));
    EXPECT_TRUE(finds(narrowed("kind='string'", "capacity='8'"), "capacity-changed", "A", 3));
    EXPECT_TRUE(finds(narrowed("kind='float' unit='m'", "unit='mm'"), "unit-changed", "A", 3,
                      "another scale"));
    EXPECT_TRUE(finds(narrowed("kind='float' unit='m'", "unit='s'"), "unit-changed", "A", 3,
                      "another quantity"));
    EXPECT_TRUE(finds(narrowed("kind='float'", "unit='s'"), "unit-changed", "A", 3));
    EXPECT_TRUE(
        finds(narrowed("kind='float'", "constant='true'"), "flag-changed", "A", 3, "constant"));
    EXPECT_TRUE(finds(narrowed("kind='float' measured='true'", "measured='false'"), "flag-changed",
                      "A", 3));
    EXPECT_TRUE(
        isValid(narrowed("kind='float' unit='m/s'", "kind='float' length='1' unit='m.s-1'")));
}

TEST(DataItem, IsRetainedWhereItSaysSoAndKeepsItsHashWhereItDoesNot) {
    const XmlModel plain = item("kind='int'"), denied = item("kind='int' retain='false'"),
                   retained = item("kind='int' retain='true'");
    ASSERT_TRUE(isValid(retained));
    EXPECT_TRUE(retained.data("A", "x").retain);
    EXPECT_FALSE(plain.data("A", "x").retain);
    EXPECT_EQ(typeHash(plain.type("A")), typeHash(denied.type("A")));
    EXPECT_NE(typeHash(plain.type("A")), typeHash(retained.type("A")));
}

TEST(DataItem, IsNotRetainedWhereARestartMustNotBringItBack) {
    for (const char* other : {"kind='int' constant='true'", "kind='int' measured='true'",
                              "kind='int' safe='0'", "kind='string' length='2'"}) {
        EXPECT_TRUE(
            finds(item("retain='true' " + std::string{other}), "retain", "A", 2, "remove retain"))
            << other;
    }
}

TEST(Narrowing, AddsRetainAndNeverTakesItBack) {
    EXPECT_TRUE(narrowed("kind='int'", "retain='true'").data("A", "x").retain);
    EXPECT_TRUE(narrowed("kind='int' retain='true'", "min='0'").data("A", "x").retain);
    EXPECT_TRUE(finds(narrowed("kind='int' retain='true'", "retain='false'"), "flag-changed", "A",
                      3, "leave retain out"));
    EXPECT_TRUE(joined("kind='int'", "kind='int' retain='true'").data("A", "x").retain);
}

TEST(Narrowing, NeverWidens) {
    EXPECT_TRUE(finds(narrowed("kind='int' min='0'", "min='-1'"), "range-widened", "A", 3,
                      "write min=\"0\""));
    EXPECT_TRUE(finds(narrowed("kind='float' max='1.5'", "max='2'"), "range-widened", "A", 3,
                      "write max=\"1.5\""));
    EXPECT_TRUE(finds(narrowed("kind='float' rate='1'", "rate='2'"), "rate-widened", "A", 3,
                      "write rate=\"1\""));
    EXPECT_TRUE(finds(narrowed("kind='int' settable='Standby'", "settable='always'"),
                      "settable-widened", "A", 3));
    EXPECT_TRUE(
        finds(narrowed("kind='int' onLimit='fault'", "onLimit='clamp'"), "limit-loosened", "A", 3));
    EXPECT_TRUE(
        finds(narrowed("kind='int' labels='0:A'", "labels='0:B'"), "label-changed", "A", 3));
    EXPECT_TRUE(isValid(narrowed("kind='int' labels='0:A'", "labels='1:B'")));
    EXPECT_TRUE(finds(narrowed("kind='int' labels='0:A'", "labels='1:A'"), "labels", "A", 3));
}

TEST(Narrowing, ChecksTheInheritedDefaultAgainstTheNewRange) {
    EXPECT_TRUE(finds(narrowed("kind='int' default='5' max='9'", "max='3'"), "default-range", "A",
                      3, "write default=\"0\""));
    EXPECT_TRUE(finds(narrowed("kind='int' safe='5' max='9'", "max='3'"), "safe-range", "A", 3));
    EXPECT_TRUE(isValid(narrowed("kind='int' max='9'", "min='3'")));
}

TEST(Narrowing, ReadsBoundsInTheInheritedKind) {
    EXPECT_TRUE(finds(narrowed("kind='int'", "max='1.5'"), "range-kind", "A", 3));
    EXPECT_EQ(narrowed("kind='float'", "max='1'").data("A", "x").max, Number{1.0});
    EXPECT_EQ(narrowed("kind='string'", "default='007'").data("A", "x").initial,
              Value{std::vector<std::string>{"007"}});
}

// Several parents

TEST(Intersection, OfADiamondIsTheOneDefinition) {
    const XmlModel model = readTypes(R"(
      <type name="Top"><data name="x" kind="float" min="-5" max="5" default="0" safe="hold"/></type>
      <type name="Left" extends="Top"><data name="x" min="-1"/></type>
      <type name="Right" extends="Top"><data name="x" max="2"/></type>
      <type name="Bottom" extends="Left Right"/>)");
    ASSERT_TRUE(isValid(model));
    const DataItem& x = model.data("Bottom", "x");
    EXPECT_EQ(x.min, Number{-1.0});
    EXPECT_EQ(x.max, Number{2.0});
    EXPECT_EQ(model.type("Bottom").data.size(), 1U);
}

TEST(AtRest, IsInheritedMayBeTakenAwayAndNeverGiven) {
    const std::string freed = "kind='int' safe='0' atRest='writer'";
    const XmlModel plain = item("kind='int' safe='0'"), free = item(freed);
    ASSERT_TRUE(isValid(free));
    EXPECT_EQ(free.data("A", "x").atRest, AtRest::Writer);
    EXPECT_NE(typeHash(plain.type("A")), typeHash(free.type("A")));
    EXPECT_EQ(typeHash(plain.type("A")),
              typeHash(item("kind='int' safe='0' atRest='safe'").type("A")));
    EXPECT_EQ(narrowed(freed, "min='0'").data("A", "x").atRest, AtRest::Writer);
    EXPECT_EQ(narrowed(freed, "atRest='safe'").data("A", "x").atRest, AtRest::Safe);
    EXPECT_TRUE(finds(narrowed("kind='int' safe='0'", "atRest='writer'"), "at-rest", "A", 3));
    EXPECT_EQ(joined("kind='int' safe='0'", freed).data("A", "x").atRest, AtRest::Safe);
    EXPECT_TRUE(finds(item("kind='int' atRest='writer'"), "at-rest", "A", 2));
}

TEST(Intersection, TakesTheTighterOfEverything) {
    const XmlModel model = joined(
        "kind='int' min='0' settable='Standby Active' labels='0:A' resolution='2' deadband='1' "
        "onLimit='fault'",
        "kind='int' min='1' max='9' settable='Active Fault' labels='1:B' resolution='1' "
        "deadband='2' safe='hold' "
        "default='4' format='d' description='q'");
    ASSERT_TRUE(isValid(model));
    const DataItem& x = model.data("A", "x");
    EXPECT_EQ(x.min, Number{std::int64_t{1}});
    EXPECT_EQ(x.max, Number{std::int64_t{9}});
    EXPECT_EQ(x.settable.text(), "Active");
    EXPECT_EQ(x.labels.size(), 2U);
    EXPECT_EQ(x.resolution, 1);
    EXPECT_EQ(x.deadband, 1);
    EXPECT_EQ(x.onLimit, OnLimit::Fault);
    EXPECT_EQ(x.safe.kind, Safe::Kind::Hold);
    EXPECT_EQ(x.initial, Value{std::vector<std::int64_t>{4}});
    EXPECT_EQ(x.format + x.description, "dq");
    EXPECT_EQ(joined("kind='float' rate='2'", "kind='float' rate='1'").data("A", "x").rate, 1);
    EXPECT_EQ(joined("kind='int'", "kind='int' settable='Fault'").data("A", "x").settable.text(),
              "Fault");
}

TEST(Intersection, ThatIsEmptyNamesBothParents) {
    const std::string both = "which exclude each other";
    EXPECT_TRUE(finds(joined("kind='int' max='1'", "kind='int' min='2'"), "intersection-empty", "A",
                      3, "range '* to 1' from 'P' and '2 to *' from 'Q', " + both));
    EXPECT_TRUE(finds(joined("kind='int'", "kind='float'"), "intersection-empty", "A", 3,
                      "kind 'int' from 'P'"));
    EXPECT_TRUE(finds(joined("kind='float' unit='m'", "kind='float' unit='mm'"),
                      "intersection-empty", "A", 3));
    EXPECT_TRUE(finds(joined("kind='int'", "kind='int' length='2'"), "intersection-empty", "A", 3));
    EXPECT_TRUE(
        finds(joined("kind='string'", "kind='string' capacity='2'"), "intersection-empty", "A", 3));
    EXPECT_TRUE(
        finds(joined("kind='int'", "kind='int' constant='true'"), "intersection-empty", "A", 3));
    EXPECT_TRUE(finds(joined("kind='int' settable='Standby'", "kind='int' settable='Fault'"),
                      "intersection-empty", "A", 3));
    EXPECT_TRUE(finds(joined("kind='int' labels='0:A'", "kind='int' labels='0:B'"),
                      "intersection-empty", "A", 3));
}

TEST(Intersection, LeavesDefaultsAndSafeValuesThatDifferToTheChild) {
    EXPECT_TRUE(finds(joined("kind='int' default='1'", "kind='int' default='2'"), "restate", "A", 3,
                      "default='1' from 'P' and '2' from 'Q'"));
    EXPECT_TRUE(
        finds(joined("kind='int' safe='hold'", "kind='int' safe='observed'"), "restate", "A", 3));
    EXPECT_TRUE(finds(joined("kind='int' safe='1'", "kind='int' safe='hold'"), "restate", "A", 3));
    const XmlModel settled =
        joined("kind='int' default='1' safe='hold'", "kind='int' default='2' safe='3'",
               "default='5' safe='observed'");
    ASSERT_TRUE(isValid(settled));
    EXPECT_EQ(settled.data("A", "x").initial, Value{std::vector<std::int64_t>{5}});
    EXPECT_EQ(settled.data("A", "x").safe.kind, Safe::Kind::Observed);
}

std::string ofLength(std::size_t length, const std::string& element) {
    std::string text;
    for (std::size_t i = 0; i < length; ++i) text += (i > 0 ? " " : "") + element;
    return "length='" + std::to_string(length) + "' default='" + text + "'";
}

TEST(DataItem, HasNoTextThatOtherAgentsDoNotGet) {
    const std::string labels(65'534, 'x');
    EXPECT_TRUE(isValid(item("kind='int' " + ofLength(32'768, "1"))));
    EXPECT_TRUE(finds(item("kind='int' " + ofLength(32'769, "1")), "text-length", "A", 2, "65537"));
    EXPECT_TRUE(isValid(item("kind='int' labels='0:" + labels + "'")));
    EXPECT_TRUE(finds(item("kind='int' labels='0:x" + labels + "'"), "text-length", "A", 2));
    EXPECT_TRUE(
        finds(readTypes("<type name='A'\nversion='" + labels + "xxx'/>"), "text-length", "A", 1));
}

TEST(DataItem, HasNoNegativeZeroAsABound) {
    for (const char* zero : {"-0.0", "-0", "-0e3"}) {
        const XmlModel model = item("kind='float' min='" + std::string{zero} + "'");
        ASSERT_TRUE(isValid(model));
        EXPECT_EQ(toText(*model.data("A", "x").min), "0") << zero;
    }
}

}  // namespace
}  // namespace cortex
