// SPDX-License-Identifier: Apache-2.0
// What users test their classes and plug-ins with.
#include "cortex/core/error.hpp"
#include "cortex/core/registry.hpp"
#include "cortex/cs/simplex_cs.hpp"
#include "cortex/cs/testing.hpp"

#include <cstdint>
#include <string>

#include <gtest/gtest.h>

namespace cortex::test {

namespace {

// Adds up what it reads.
class Adder : public cs::SimplexCS {
public:
    using SimplexCS::SimplexCS;

private:
    void populate() override {
        read_ = inputs("in")[0].data<double>("value");
        result_ = data<double>("result");
        on<&Adder::poke>("poke");
        on<&Adder::add>("add");
    }
    void stateActive(const Tick&) override {
        sum_ += read_;
        if (sum_ > 10) result_ = sum_;
    }
    void keep(Archive& archive) override { archive & sum_; }
    Outcome poke(Call&) { return Outcome::Done; }
    Outcome add(Call&) { return Outcome::Done; }

    Data<const double> read_;
    Data<double> result_;
    double sum_ = 0;
};

class ForgetfulAdder final : public Adder {
public:
    using Adder::Adder;

private:
    void keep(Archive&) override {}
};

template <class Class = Adder>
class AdderPlant : public cs::TestPlant {
public:
    AdderPlant() : TestPlant{{CORTEX_SOURCE_DIR "/tests/data/cs-rules.xml"}} {
        classes().template add<Class>("Probe");
        add("/signal", "Signal");
        add("/adder", "Probe", {{"in", "/signal"}}, {{"gain", "2"}});
        start();
        startUp();
    }
    void run(double value, std::int64_t cycles) {
        tree().at("/signal").template data<double>("value") = value;
        step(cycles);
    }
};

TEST(TestPlant, IsSteppedByHandAndCommanded) {
    AdderPlant<> plant;
    const std::int64_t before = plant.cycle();

    plant.run(3, 4);

    EXPECT_EQ(plant.cycle(), before + 4);
    EXPECT_EQ(plant.state("/adder"), State::Active);
    EXPECT_EQ(plant.get<double>("/adder", "result"), 12);
    EXPECT_EQ(plant.get<double>("/adder", "gain"), 2);
    EXPECT_EQ(plant.call("/adder", "poke").outcome, Outcome::Done);
    EXPECT_EQ(plant.call("/adder", "set", {{"gain", 99.0}}).outcome, Outcome::Rejected);
}

TEST(TestPlant, RefusesWhatWouldNeverReturnOrBeForgotten) {
    cs::TestPlant plant{{CORTEX_SOURCE_DIR "/tests/data/cs-rules.xml"}};
    EXPECT_THROW(plant.step(), Error);
    EXPECT_THROW(plant.standStill(1), Error);
    plant.add("/signal", "Signal");
    plant.start();
    EXPECT_THROW(plant.add("/late", "Signal"), Error);
    EXPECT_THROW(plant.standStill(-3), Error);
    const std::int64_t before = plant.cycle();
    plant.step();
    EXPECT_EQ(plant.cycle(), before + 1);
}

TEST(TestPlant, GoesOnFromWhatAnotherOneSaved) {
    AdderPlant<> saved, fresh;
    saved.run(3, 3);

    fresh.restore(saved.save());

    EXPECT_EQ(fresh.save(), saved.save());
    saved.run(3, 1);
    fresh.run(3, 1);
    EXPECT_EQ(cs::TestPlant::differences(saved.values(), fresh.values()), "");
    EXPECT_EQ(fresh.get<double>("/adder", "result"), 12);
}

TEST(TestPlant, NamesTheItemThatAClassDidNotKeepWhatItNeedsFor) {
    AdderPlant<ForgetfulAdder> saved, fresh;
    saved.run(3, 3);

    fresh.restore(saved.save());
    saved.run(3, 1);
    fresh.run(3, 1);

    EXPECT_EQ(cs::TestPlant::differences(saved.values(), fresh.values()),
              "/adder.result is 12 and 0\n");
}

TEST(TestPlant, RefusesWhatIsWrongInWords) {
    cs::TestPlant plant{{CORTEX_SOURCE_DIR "/tests/data/cs-rules.xml"}};
    plant.add("/axis", "Obzervation");
    try {
        plant.start();
        FAIL();
    } catch (const ModelError& error) {
        EXPECT_NE(std::string{error.what()}.find("Observation"), std::string::npos) << error.what();
    }
    AdderPlant<> other;
    cs::TestPlant::Saved saved = other.save();
    saved.tables.pop_back();
    EXPECT_THROW(other.restore(saved), Error);
}

}  // namespace

}  // namespace cortex::test
