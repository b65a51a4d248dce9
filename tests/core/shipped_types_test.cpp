// SPDX-License-Identifier: Apache-2.0
#include "cortex/core/type_model.hpp"

#include <iterator>
#include <sstream>
#include <string>
#include <vector>

#include <gtest/gtest.h>

// What users read of the shipped types, on screens and in files.
namespace cortex {
namespace {

const TypeModel& shipped() {
    static const TypeModel model =
        TypeModel::load(CORTEX_SOURCE_DIR "/ontology/cortex-morphology.xml");
    return model;
}

class Descriptions {
public:
    void take(const std::string& what, const std::string& description) {
        std::istringstream words{description};
        const auto count = std::distance(std::istream_iterator<std::string>{words}, {});
        if (count < 5) poor_ += what + ": '" + description + "'\n";
        ++taken_;
    }
    void takeItems(const std::string& owner, const std::vector<DataItem>& items) {
        for (const DataItem& item : items) take(owner + "." + item.name, item.description);
    }
    const std::string& poor() const { return poor_; }
    int taken() const { return taken_; }

private:
    std::string poor_;
    int taken_ = 0;
};

TEST(EveryShippedType, SaysInFiveWordsOrMoreWhatItAndItsPartsAre) {
    Descriptions read;
    for (const auto& [name, type] : shipped().types()) {
        read.take(name, type.description);
        read.takeItems(name, type.data);
        for (const Command& command : type.commands) {
            const std::string path = name + "." + command.name + "()";
            read.take(path, command.description);
            read.takeItems(path, command.request);
            read.takeItems(path, command.response);
        }
        for (const Rule& rule : type.rules) read.take(name + " -> " + rule.name, rule.description);
    }

    EXPECT_EQ(read.poor(), "");
    EXPECT_GT(read.taken(), 700) << "what is inherited counts for each type";
}

TEST(EveryShippedType, IsInTheModelThatToolsTakeByThemselves) {
    for (const char* type : {"Cluster", "KukaLbr", "AnalogueInputGroup", "Gantry", "JogController"})
        EXPECT_NE(shipped().find(type), nullptr) << type;
}

TEST(EveryShippedType, LeavesNoUnitOpenWhereItCanBeMade) {
    for (const auto& [name, type] : shipped().types()) {
        for (const DataItem& item : type.data)
            EXPECT_TRUE(type.isAbstract || item.unit != "*") << name << "." << item.name;
    }
}

}  // namespace
}  // namespace cortex
