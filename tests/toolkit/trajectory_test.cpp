// SPDX-License-Identifier: Apache-2.0
// Teach and repeat, with files.
#include "cortex/cs/cluster_cs.hpp"

#include "core/model_folder.hpp"
#include "rig.hpp"

#include <algorithm>
#include <cmath>
#include <filesystem>
#include <string>
#include <vector>

#include <sys/stat.h>

#include <gtest/gtest.h>

namespace cortex::toolkit::test {
namespace {

// Three limited axes with drives, and a controller that is taught.
class Taught {
public:
    explicit Taught(const std::string& files = "", const std::string& folder = "")
        : cluster_{"arm", optionsFor(files)} {
        addClasses(registry_);
        Report report;
        tree_.add(system(folder), &registry_, report);
        if (!report.ok()) throw ModelError(std::move(report));
        cluster_.addSimplexTree(tree_);
        trigger_ = &cluster_.setTriggerSource<cs::ManualTrigger>(std::chrono::milliseconds{1});
        cluster_.start();
        cluster_.send("/arm", "startup", {{"prefix", std::string{"/"}}});
        step(20);
    }
    ~Taught() { cluster_.stop(); }

    void step(int cycles = 1) { trigger_->step(cycles); }
    // Steps until it is answered.
    CallResult call(const std::string& command, const ProgramInterface::Arguments& arguments = {}) {
        const std::uint64_t sent = cluster_.program().post("/points", command, arguments);
        CallResult result;
        for (int cycle = 0; cycle < 60'000; ++cycle) {
            if (cluster_.program().poll(sent, result)) return result;
            step();
        }
        throw Error{command + " has no answer"};
    }
    void send(const std::string& command, const ProgramInterface::Arguments& arguments = {}) {
        cluster_.send("/points", command, arguments);
    }
    // Nobody renews it, so it is lost after 2 s.
    void takeControl() {
        cluster_.send("/arm", "takeControl", {{"prefix", std::string{"/points"}}});
        step(2);
    }
    CallResult goTo(std::vector<double> pose) {
        pose.resize(16);
        call("set", {{"pose", pose}});
        const CallResult result = call("moveTo", {{"speedShare", 1.0}});
        step(600);  // the drives follow
        return result;
    }
    std::vector<double> pose() {
        std::vector<double> now;
        for (const char* axis : {"/axis1", "/axis2", "/axis3"})
            now.push_back(cluster_.image().get<double>(axis, "position"));
        return now;
    }
    double fastest() {
        double most = 0;
        for (const char* demand : {"/demand1", "/demand2", "/demand3"})
            most = std::max(most, std::abs(cluster_.image().get<double>(demand, "velocity")));
        return most;
    }
    std::int64_t point() { return cluster_.image().get<std::int64_t>("/points", "point"); }
    std::int64_t count() { return cluster_.image().get<std::int64_t>("/points", "pointCount"); }
    void teachThree() {
        for (const auto& pose : {std::vector{0.5, 0.2, 0.0}, {0.0, 1.0, -0.5}, {-0.4, 0.1, 0.3}}) {
            goTo(pose);
            EXPECT_EQ(call("teach").outcome, Outcome::Done);
        }
    }

private:
    static cs::ClusterOptions optionsFor(const std::string& files) {
        cs::ClusterOptions options;
        options.files = files;
        return options;
    }
    static SystemDescription system(const std::string& folder) {
        SystemDescription system;
        const auto add = [&](const std::string& path, const std::string& type,
                             const std::vector<std::pair<std::string, std::string>>& relates) {
            SystemDescription::SimplexEntry entry;
            entry.path = path;
            entry.type = type;
            for (const auto& [rule, to] : relates)
                entry.relates.push_back({rule, to, false, false, {}});
            if (!folder.empty() && type == "JointTrajectoryController")
                entry.settings.push_back({"folder", folder, {}, false});
            system.simplexes.push_back(entry);
        };
        std::vector<std::pair<std::string, std::string>> both;
        for (const std::string number : {"1", "2", "3"}) {
            add("/demand" + number, "LimitedAxis", {});
            add("/axis" + number, "RotaryAxisObservation", {});
            add("/drive" + number, "SimulatedAxis",
                {{"demand", "/demand" + number}, {"observation", "/axis" + number}});
            both.emplace_back("axes", "/axis" + number);
            both.emplace_back("demands", "/demand" + number);
        }
        add("/points", "JointTrajectoryController", both);
        return system;
    }

    ClassRegistry registry_;
    const std::vector<std::filesystem::path> files_{
        CORTEX_SOURCE_DIR "/ontology/cortex-morphology.xml",
        CORTEX_SOURCE_DIR "/tests/data/limited-axes.xml"};
    SimplexTree tree_ = SimplexTree::load(files_, &registry_);
    cs::ClusterCS cluster_;
    cs::ManualTrigger* trigger_ = nullptr;
};

bool isAt(const std::vector<double>& pose, const std::vector<double>& wanted) {
    return std::ranges::equal(pose, wanted,
                              [](double a, double b) { return std::abs(a - b) < 0.01; });
}

TEST(ATrajectory, IsTaughtPointByPointAndRepeated) {
    Taught arm;
    arm.teachThree();
    EXPECT_EQ(arm.count(), 3);
    arm.goTo({0.5, 0.2, 0.0});

    const CallResult result = arm.call("run");

    EXPECT_EQ(result.outcome, Outcome::Done) << result.text();
    arm.step(600);
    EXPECT_EQ(arm.point(), 3);
    EXPECT_TRUE(isAt(arm.pose(), {-0.4, 0.1, 0.3}));
}

TEST(ATrajectory, RestsInEachPoint) {
    Taught arm;
    arm.teachThree();
    std::vector<std::vector<double>> rested;
    arm.send("run", {{"from", std::int64_t{1}}});
    std::int64_t last = 0;
    for (int i = 0; i < 20'000 && rested.size() < 2; ++i) {
        arm.step();
        if (arm.point() > 1 && arm.point() != last) {
            rested.push_back(arm.pose());
            EXPECT_LT(arm.fastest(), 1e-3) << "at rest, or in the first cycle to the next";
        }
        last = std::max(last, arm.point());
    }
    ASSERT_EQ(rested.size(), 2U);
    EXPECT_NEAR(rested[0][0], 0.5, 0.1) << "it turns to point 2 where the demand has reached 1";
    EXPECT_NEAR(rested[1][1], 1.0, 0.1);
}

TEST(ATrajectory, BeginsOnlyWhereTheAxesStandOrWhereItIsTold) {
    Taught arm;
    arm.teachThree();
    const CallResult refused = arm.call("run");
    EXPECT_EQ(refused.outcome, Outcome::Rejected);
    EXPECT_NE(refused.text().find("from point 1, more than 0.05"), std::string::npos)
        << refused.text();
    EXPECT_EQ(arm.call("run", {{"from", std::int64_t{2}}}).outcome, Outcome::Done);
    EXPECT_EQ(arm.point(), 3);
}

TEST(ATrajectory, LeadsBackwardsToo) {
    Taught arm;
    arm.teachThree();
    EXPECT_EQ(arm.call("run", {{"from", std::int64_t{3}}, {"to", std::int64_t{1}}}).outcome,
              Outcome::Done);
    arm.step(600);
    EXPECT_TRUE(isAt(arm.pose(), {0.5, 0.2, 0.0}));
}

TEST(ATrajectory, GoesOnWithOneStepForwardsAndBackwards) {
    Taught arm;
    EXPECT_EQ(arm.call("next").outcome, Outcome::Rejected) << "there are none";
    arm.teachThree();
    EXPECT_EQ(arm.call("previous").outcome, Outcome::Done);
    EXPECT_EQ(arm.point(), 2);
    EXPECT_EQ(arm.call("next").outcome, Outcome::Done);
    EXPECT_EQ(arm.point(), 3);
    const CallResult beyond = arm.call("next");
    EXPECT_EQ(beyond.outcome, Outcome::Rejected);
    EXPECT_NE(beyond.text().find("there are 3 points"), std::string::npos) << beyond.text();
}

TEST(ATrajectory, BeginsAgainWhileItLoopsAndStopsWhereItIsCancelled) {
    Taught arm;
    arm.teachThree();
    arm.call("set", {{"loop", std::vector{true}}, {"speedShare", std::vector{1.0}}});
    arm.send("run", {{"from", std::int64_t{1}}});
    int rounds = 0;
    std::int64_t last = 0;
    for (int i = 0; i < 60'000 && rounds < 2; ++i) {
        arm.step();
        rounds += last == 3 && arm.point() == 1;
        last = arm.point();
    }
    EXPECT_EQ(rounds, 2);
    arm.send("cancel");
    arm.step(2000);
    const std::vector<double> rests = arm.pose();
    arm.step(200);
    EXPECT_TRUE(isAt(arm.pose(), rests));
}

TEST(ATrajectory, BrakesAndSaysWhyWhenControlIsLost) {
    Taught arm;
    arm.teachThree();
    arm.call("set", {{"loop", std::vector{true}}});
    arm.takeControl();

    const CallResult ended = arm.call("run", {{"from", std::int64_t{1}}});

    EXPECT_EQ(ended.outcome, Outcome::Cancelled);
    EXPECT_EQ(ended.why, "control was lost");
    arm.step(400);
    EXPECT_EQ(arm.fastest(), 0);
}

TEST(ATrajectory, IsTaughtAtRestOnly) {
    Taught arm;
    arm.call("set", {{"pose", std::vector<double>(16, 1.0)}});
    arm.send("moveTo");
    arm.step(50);
    const CallResult result = arm.call("teach");
    EXPECT_EQ(result.outcome, Outcome::Rejected);
    EXPECT_NE(result.text().find("moving"), std::string::npos) << result.text();
}

TEST(ATrajectory, IsNotTaughtOutOfRange) {
    Rig rig;
    rig.add("/axis", "RotaryAxisObservation");
    rig.add("/demand", "LimitedAxis");
    rig.add("/points", "JointTrajectoryController", {{"axes", "/axis"}, {"demands", "/demand"}});
    rig.start();
    rig.startUp();
    rig.tree().at("/axis").data<double>("position") = 3.2;
    const CallResult refused = rig.call("/points", "teach");
    EXPECT_EQ(refused.outcome, Outcome::Rejected);
    EXPECT_NE(refused.text().find("is 3.2, above 3, the limit of /demand"), std::string::npos)
        << refused.text();

    rig.tree().at("/axis").data<double>("position") = 3.0005;  // it swings at the end
    EXPECT_EQ(rig.call("/points", "teach").outcome, Outcome::Done);
}

TEST(ATrajectory, TakesPointsInBetweenAndLosesOthers) {
    Taught arm;
    arm.teachThree();
    arm.goTo({1, 1, 1});
    EXPECT_EQ(arm.call("insert", {{"at", std::int64_t{2}}}).outcome, Outcome::Done);
    EXPECT_EQ(arm.call("remove", {{"at", std::int64_t{1}}}).outcome, Outcome::Done);
    const CallResult shown = arm.call("showPoint", {{"number", std::int64_t{1}}});
    EXPECT_EQ(shown.outcome, Outcome::Done);
    EXPECT_NEAR(std::get<std::vector<double>>(shown.response.at("position"))[2], 1, 0.01);
    EXPECT_EQ(arm.count(), 3);
    EXPECT_EQ(arm.call("remove", {{"at", std::int64_t{4}}}).outcome, Outcome::Rejected);
    EXPECT_EQ(arm.call("clear").outcome, Outcome::Done);
    EXPECT_EQ(arm.count(), 0);
}

TEST(ATrajectory, HasRoomFor64Points) {
    Taught arm;
    for (int i = 0; i < 64; ++i) ASSERT_EQ(arm.call("teach").outcome, Outcome::Done) << i;
    const CallResult result = arm.call("teach");
    EXPECT_EQ(result.outcome, Outcome::Rejected);
    EXPECT_NE(result.text().find("64 points"), std::string::npos) << result.text();
}

TEST(FilesOfPoints, AreReadByAnotherStart) {
    const cortex::test::ModelFolder folder;
    std::vector<double> first;
    {
        Taught arm{folder.path().string(), "arm"};
        arm.teachThree();
        EXPECT_EQ(arm.call("save", {{"name", std::string{"pick_1"}}}).outcome, Outcome::Done);
    }
    EXPECT_EQ(folder.read("arm/pick_1.csv").find("/axis1 rad,/axis2 rad,/axis3 rad\n"), 0U)
        << folder.read("arm/pick_1.csv");

    Taught arm{folder.path().string(), "arm"};
    EXPECT_EQ(arm.call("load", {{"name", std::string{"pick_1"}}}).outcome, Outcome::Done);

    EXPECT_EQ(arm.count(), 3);
    EXPECT_EQ(arm.call("run", {{"from", std::int64_t{2}}}).outcome, Outcome::Done);
    arm.step(600);
    EXPECT_TRUE(isAt(arm.pose(), {-0.4, 0.1, 0.3}));
}

TEST(FilesOfPoints, AreRefusedInWords) {
    const cortex::test::ModelFolder folder;
    folder.write("other.csv", "/other rad\n1\n");
    folder.write("words.csv", "/axis1 rad,/axis2 rad,/axis3 rad\n1,2,three\n");
    folder.write("few.csv", "/axis1 rad,/axis2 rad,/axis3 rad\n1,2\n");
    folder.write("nan.csv", "/axis1 rad,/axis2 rad,/axis3 rad\n1,2,nan\n");
    std::string many = "/axis1 rad,/axis2 rad,/axis3 rad\n";
    for (int i = 0; i < 65; ++i) many += "1,2,3\n";
    folder.write("many.csv", many);
    folder.write("far.csv", "/axis1 rad,/axis2 rad,/axis3 rad\n1,2,2\n1,-3.5,2\n");
    folder.write("zero.csv", std::string{"/axis1 rad,/axis2 rad,/axis3 rad\n1,2,a\0b\n", 40});
    folder.write("empty.csv", "");
    ASSERT_EQ(::mkfifo((folder.path() / "pipe.csv").c_str(), 0600), 0);
    Taught arm{folder.path().string()};
    arm.call("teach");
    const std::pair<const char*, const char*> cases[] = {
        {"none", "there is no file"},
        {"other", "it is for other axes"},
        {"words", "words.csv:2: 'three'"},
        {"few", "few.csv:2: 2 numbers for 3 axes"},
        {"nan", "'nan' is no number"},
        {"many", "more than 64 points"},
        {"../x", "letters, digits"},
        {"", "letters, digits"},
        {"far", "far.csv:3: /axis2 rad is -3.5, below -3, the limit of /demand2"},
        {"zero", "'a?b' is no number"},
        {"empty", "empty.csv is empty"},
        {"pipe", "pipe.csv is no file"},
    };
    for (const auto& [name, words] : cases) {
        const CallResult result = arm.call("load", {{"name", std::string{name}}});
        EXPECT_EQ(result.outcome, Outcome::Failed) << name;
        EXPECT_NE(result.text().find(words), std::string::npos) << name << ": " << result.text();
    }
    EXPECT_EQ(arm.count(), 1) << "those that were there stay";
}

TEST(FilesOfPoints, MayComeFromASpreadsheet) {
    const cortex::test::ModelFolder folder;
    folder.write("sheet.csv", "\xef\xbb\xbf/axis1 rad,/axis2 rad,/axis3 rad\r\n1,2,2.5\r\n\r\n");
    Taught arm{folder.path().string()};

    const CallResult result = arm.call("load", {{"name", std::string{"sheet"}}});

    EXPECT_EQ(result.outcome, Outcome::Done) << result.text();
    EXPECT_EQ(arm.count(), 1);
}

TEST(FilesOfPoints, AreWrittenWhereAPipeWouldBlock) {
    const cortex::test::ModelFolder folder;
    ASSERT_EQ(::mkfifo((folder.path() / "a.csv.new").c_str(), 0600), 0);
    Taught arm{folder.path().string()};
    arm.call("teach");

    EXPECT_EQ(arm.call("save", {{"name", std::string{"a"}}}).outcome, Outcome::Done);
    EXPECT_EQ(folder.read("a.csv"), "/axis1 rad,/axis2 rad,/axis3 rad\n0,0,0\n");
}

TEST(FilesOfPoints, NeedAFolderOfTheProgram) {
    Taught arm;
    const CallResult result = arm.call("save", {{"name", std::string{"a"}}});
    EXPECT_EQ(result.outcome, Outcome::Failed);
    EXPECT_NE(result.text().find("--files FOLDER"), std::string::npos) << result.text();
}

}  // namespace
}  // namespace cortex::toolkit::test
