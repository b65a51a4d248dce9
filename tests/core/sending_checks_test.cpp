// SPDX-License-Identifier: Apache-2.0
#include "cortex/core/sending_checks.hpp"

#include "cortex/core/make_structure.hpp"
#include "cortex/core/validation.hpp"

#include "core/xml_model.hpp"

#include <algorithm>
#include <string>
#include <utility>

#include <gtest/gtest.h>

// Whether other agents could read what an agent says of itself.
namespace cortex {
namespace {

using test::readTypes;
using test::XmlModel;

// Of simplexes /0, /1, … of the type A.
Report sending(const std::string& types, int simplexes) {
    XmlModel model = readTypes(types);
    EXPECT_TRUE(test::isValid(model));
    SimplexTree tree{std::move(model.files.types)};
    for (int i = 0; i < simplexes; ++i) tree.add("/" + std::to_string(i), "A");
    return checkSending(tree, *makeStructure("", tree));
}

// With an item of so many texts, each of which can take 4,104 octets.
std::string texts(int length, const std::string& more = "") {
    return "<type name='A'><data name='x' kind='string' capacity='4096' length='" +
           std::to_string(length) + "' " + more + "/></type>";
}

TEST(Sending, OfUsualTypesIsPossible) {
    EXPECT_EQ(sending("<type name='A'><data name='x' kind='float' min='-0.0' default='-0.0'/>"
                      "</type>",
                      3)
                  .text(),
              "");
}

TEST(Sending, OfMoreValuesThanOneBlockHasIsWarnedOf) {
    EXPECT_EQ(sending(texts(1000), 4).text(), "");
    const Report report = sending(texts(1000), 5);
    ASSERT_EQ(report.findings.size(), 1U);
    EXPECT_TRUE(report.ok());
    EXPECT_EQ(report.findings[0].rule, "data-size");
}

TEST(Sending, OfMoreValuesThanAnyoneReadsIsWarnedOf) {
    const Report report = sending(texts(65'536), 1);
    ASSERT_EQ(report.findings.size(), 2U);
    EXPECT_NE(report.findings[1].message.find("256 MiB"), std::string::npos);
}

TEST(Sending, OfTooManyConstantsOfOneSimplexIsWarnedOf) {
    EXPECT_EQ(sending(texts(4088, "constant='true'"), 2).text(), "");
    const Report report = sending(texts(4089, "constant='true'"), 1);
    ASSERT_EQ(report.findings.size(), 1U);
    EXPECT_EQ(report.findings[0].path, "/0");
}

TEST(Sending, OfATypeWithMoreTextThanOneSampleHasIsAnError) {
    TypeDeclaration type;
    type.name = "A";
    type.place = {"t.xml", 7};
    DataItem item;
    item.kind = Kind::Int;
    for (int i = 0; i < 1000; ++i) item.labels[i] = "l" + std::to_string(i) + std::string(56, 'x');
    for (int i = 0; i < 270; ++i) {
        item.name = "x" + std::to_string(i);
        type.data.push_back(item);
    }
    Report none;
    SimplexTree tree{TypeModel::build({type}, none)};
    ASSERT_TRUE(none.ok()) << none.text();
    tree.add("/a", "A");

    const Report report = checkSending(tree, *makeStructure("", tree));

    ASSERT_EQ(report.findings.size(), 1U) << report.text();
    EXPECT_EQ(report.findings[0].rule, "model-size");
    EXPECT_EQ(report.findings[0].path, "A");
    EXPECT_EQ(report.findings[0].place.line, 7);
}

TEST(Sending, OfATextThatOthersDoNotReadAsItIsIsNotValid) {
    XmlModel model = readTypes("<type name='A'><data name='x' kind='string'/></type>");
    for (const std::string& text : {std::string{"\xff"}, std::string{"a\0b", 3}}) {
        SimplexTree tree{model.files.types};
        tree.add("/a", "A").set("x", text);
        const Report report = validate(tree);
        EXPECT_EQ(std::ranges::count(report.findings, "setting-kind", &Finding::rule), 1)
            << report.text();
    }
}

TEST(Sending, OfMorePathsOfOthersThanOneMessageHasIsAnError) {
    XmlModel model = readTypes("<type name='A'/>",
                               "<rules type='A'><relationship name='r' direction='input' "
                               "target='A'/></rules>");
    for (const int count : {640, 641}) {
        SimplexTree tree{model.files.types};
        Simplex& reader = tree.add("/a", "A");
        for (int i = 0; i < count; ++i) {
            std::string path = "/" + std::to_string(i);
            path += std::string(92 - path.size(), 'x');
            tree.relateRemote(reader, "r", path);
        }
        const Report report = checkSending(tree, *makeStructure("", tree));
        EXPECT_EQ(report.ok(), count == 640) << report.text();
    }
}

}  // namespace
}  // namespace cortex
