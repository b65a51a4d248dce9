// SPDX-License-Identifier: Apache-2.0
#include "cortex/core/error.hpp"

#include "support/probe.hpp"

#include <string>

#include <gtest/gtest.h>

namespace cortex::test {

namespace {

using namespace std::chrono_literals;

template <class Action>
std::string refusalOf(Action action) {
    try {
        action();
    } catch (const Error& error) {
        return error.what();
    }
    return "not refused";
}

bool contains(const std::string& text, std::string_view part) {
    return text.find(part) != std::string::npos;
}

TEST(UnboundHandles, PutTheSimplexIntoFaultWithHandleHookAndType) {
    ProbeCluster cluster;
    Data<double> forgotten;
    cluster.probe("/ctl").onActive = [&](Probe&, const Tick&) { forgotten = 1; };
    int others = 0;
    cluster.probe("/other").onLoopStart = [&](Probe&, const Tick&) { ++others; };
    cluster.start();
    cluster.call("/ctl", "startup");

    cluster.step(3);

    EXPECT_EQ(cluster.state("/ctl"), State::Fault);
    EXPECT_EQ(cluster.integer("/ctl", "faultCode"), -1);
    EXPECT_TRUE(
        cluster.hasEvent("/ctl: fault -1: handle Data<double> is not bound (forgotten in "
                         "populate()?); used in stateActive of Probe"));
    EXPECT_EQ(cluster.cluster->image().get<std::string_view>("/ctl", "faultText"),
              "unbound Data<double> in stateActive");
    EXPECT_GE(others, 4);
}

// Members as a user writes them; `used`: which of them the hook uses.
class Forgetful final : public Probe {
public:
    enum class Member { Start, Middle, End };
    Forgetful(Identity identity, Member used) : Probe{std::move(identity)}, used_{used} {}

private:
    void populate() override {
        Probe::populate();
        gain_ = data<double>("gain");
        seen_ = input("in").data<double>("value");
    }
    void stateStandby(const Tick&) override {
        if (used_ == Member::Start) start_ = 1;
        if (used_ == Member::Middle) gain_ = middle_;
        if (used_ == Member::End) end_ = "x";
    }

    Member used_;
    Data<std::int64_t> start_;
    Data<double> gain_;
    Data<const double> middle_;
    Data<const double> seen_;
    Data<std::string_view> end_;
};

TEST(UnboundHandles, AreFoundByTheItemsOfTheirNeighboursInTheClass) {
    using Member = Forgetful::Member;
    const std::pair<Member, std::string> cases[] = {
        {Member::Start, "handle Data<std::int64_t> before that of 'gain' is not bound"},
        {Member::Middle,
         "handle Data<const double> between those of 'gain' and 'value' is not "
         "bound (forgotten in populate()?); used in stateStandby of Probe"},
        {Member::End, "handle Data<std::string_view> after that of 'value' is not bound"}};
    for (const auto& [member, text] : cases) {
        ProbeCluster cluster;
        Simplex& signal = cluster.tree.add("/signal", "Signal");
        auto& reader = cluster.tree.add<Forgetful>("/reader", "Probe", member);
        cluster.tree.relate(reader, "in", signal);
        cluster.start();
        cluster.step();

        EXPECT_TRUE(cluster.hasEvent(text)) << text;
    }
}

TEST(UnboundHandles, LeaveOutTheirTypeWhereItDoesNotFitIntoFaultText) {
    ProbeCluster cluster;
    Data<std::string_view> forgotten;
    cluster.probe("/a").onStartingUp = [&](Probe&, const Tick&) { return forgotten = "x", true; };
    cluster.start();
    cluster.call("/a", "startup");
    cluster.step(2);

    EXPECT_EQ(cluster.cluster->image().get<std::string_view>("/a", "faultText"),
              "unbound handle in stateStartingUp");
    EXPECT_TRUE(cluster.hasEvent("handle Data<std::string_view> is not bound"));
}

TEST(UnboundHandles, AreFoundForSendersToo) {
    ProbeCluster cluster;
    CommandSender command;
    Probe::LifeCycleSender lifeCycle;
    cluster.probe("/a").onLoopStart = [&](Probe&, const Tick&) { command.send(); };
    cluster.probe("/b").onLoopStart = [&](Probe&, const Tick&) { lifeCycle.startup(); };
    cluster.start();
    cluster.step();

    EXPECT_TRUE(cluster.hasEvent("/a: fault -1: handle CommandSender is not bound"));
    EXPECT_TRUE(cluster.hasEvent("/b: fault -1: handle LifeCycleSender is not bound"));
}

TEST(UnboundHandles, ThatPopulateUsesAreFindingsOfTheStart) {
    ProbeCluster cluster;
    Data<double> forgotten;
    cluster.probe("/ctl").onPopulate = [&](Probe& self) {
        Data<double> gain = self.data<double>("gain");
        forgotten = gain;  // copies a value into what is not bound
    };

    const std::string refusal = refusalOf([&] { cluster.start(); });

    EXPECT_TRUE(contains(refusal, "/ctl")) << refusal;
    EXPECT_TRUE(contains(refusal, "handle Data<double> is used before it is bound: = with a value"))
        << refusal;
    EXPECT_TRUE(contains(refusal, "is bound by =")) << refusal;
}

TEST(HandlesOfRelatedSimplexes, AreGotInPopulateOnlyAndLaterOnesAreAFaultThatSaysSo) {
    ProbeCluster cluster;
    Simplex& signal = cluster.tree.add("/signal", "Signal");
    Probe& writer = cluster.probe("/writer");
    Probe& reader = cluster.probe("/reader");
    cluster.tree.relate(writer, "out", signal);
    cluster.tree.relate(reader, "in", signal);
    writer.onActive = [](Probe& self, const Tick&) {
        Data<double> late = self.output("out").data<double>("value");
        late = 3;
    };
    reader.onActive = [](Probe& self, const Tick&) { self.input("in").data<double>("value"); };
    cluster.start();
    cluster.call("/writer", "startup");
    cluster.call("/reader", "startup");
    cluster.step(3);

    EXPECT_TRUE(
        cluster.hasEvent("/writer: fault -1: /writer: /signal.value: its handle is got in "
                         "populate(), not later: keep it in a member"));
    EXPECT_TRUE(cluster.hasEvent("/reader: /signal.value: its handle is got in populate()"));
    EXPECT_EQ(cluster.number("/signal", "value"), 0);
}

TEST(RelatedSimplexes, BeyondThoseThatThereAreAreFindingsOfTheStart) {
    ProbeCluster cluster;
    Simplex& signal = cluster.tree.add("/signal", "Signal");
    Probe& reader = cluster.probe("/reader");
    cluster.tree.relate(reader, "in", signal);
    reader.onPopulate = [](Probe& self) { self.inputs("in")[2].data<double>("value"); };
    cluster.probe("/lonely").onPopulate = [](Probe& self) { self.outputs("out")[0].path(); };

    const std::string refusal = refusalOf([&] { cluster.start(); });

    EXPECT_TRUE(contains(refusal, "/reader")) << refusal;
    EXPECT_TRUE(contains(refusal,
                         "rule 'in' relates 1 simplex, so there is no [2]: [0] is the "
                         "first, or ask size() before"))
        << refusal;
    EXPECT_TRUE(contains(refusal, "rule 'out' relates 0 simplexes, so there is no [0]: relate one"))
        << refusal;
}

TEST(TheTree, IsFixedWhileAnAgentRunsWithIt) {
    ProbeCluster cluster;
    Probe& probe = cluster.probe("/a");
    Simplex& signal = cluster.tree.add("/signal", "Signal");
    cluster.start();
    const std::string why =
        ": agent /test runs with this tree, whose layout start() has fixed: "
        "add and relate before it";

    EXPECT_EQ(refusalOf([&] { cluster.tree.add("/late", "Signal"); }), "/late" + why);
    EXPECT_EQ(refusalOf([&] { cluster.probe("/late"); }), "/late" + why);
    EXPECT_EQ(refusalOf([&] { cluster.tree.relate(probe, "in", signal); }), "/a" + why);
    EXPECT_EQ(refusalOf([&] { cluster.tree.relateRemote(probe, "in", "/far"); }), "/a" + why);
    EXPECT_EQ(cluster.tree.find("/late"), nullptr);
    cluster.cluster.reset();
    cluster.tree.add("/late", "Signal");
    EXPECT_NE(cluster.tree.find("/late"), nullptr);
}

TEST(LifeCycleSenders, CommandTheSameSimplexWhenTheyAreCopied) {
    ProbeCluster cluster;
    Probe& manager = cluster.probe("/manager");
    Probe& worker = cluster.probe("/worker");
    cluster.tree.relate(manager, "after", worker);
    Probe::LifeCycleSender first, copy, unbound;
    manager.onPopulate = [&](Probe& self) {
        first = self.lifeCycle(self.output("after"));
        copy = first;
    };
    State seen = State::Fault;
    manager.onActive = [&](Probe&, const Tick&) {
        seen = copy.state();
        copy.startup();
    };
    cluster.probe("/forgetful").onLoopStart = [&](Probe&, const Tick&) { unbound.state(); };
    cluster.start();
    cluster.startup(manager);
    cluster.step(3);

    EXPECT_EQ(cluster.state("/worker"), State::Active);
    EXPECT_EQ(seen, State::Active);
    EXPECT_TRUE(cluster.hasEvent("/forgetful: fault -1: handle LifeCycleSender is not bound"));
}

TEST(Handlers, ThatAnswerWhatIsNoAnswerAreToldSo) {
    ProbeCluster cluster;
    Probe& probe = cluster.probe("/long", "LongProbe");
    probe.onPoke = [](Probe&, Call&) { return Outcome::None; };
    probe.onWork = [](Probe&, Call&) { return Outcome::MailboxFull; };
    cluster.start();
    cluster.startup(probe);

    const CallResult none = cluster.call("/long", "poke");
    EXPECT_EQ(none.outcome, Outcome::Failed);
    EXPECT_TRUE(contains(none.text(),
                         "its handler returned None, which is no answer of a handler: "
                         "Done, Running, Cancelled, call.fail() and call.reject() are"))
        << none.text();
    const CallResult full = cluster.call("/long", "work");
    EXPECT_EQ(full.outcome, Outcome::Failed);
    EXPECT_TRUE(contains(full.text(), "its handler returned MailboxFull")) << full.text();
}

TEST(Commands, AreNotSentWhileAParameterWithoutADefaultWasNeverSet) {
    ProbeCluster cluster;
    CommandSender add;
    Data<double> amount;
    Outcome sent = Outcome::None;
    std::vector<double> executed;
    Probe& sender = cluster.probe("/a");
    Probe& receiver = cluster.probe("/b");
    cluster.tree.relate(sender, "after", receiver);
    sender.onPopulate = [&](Probe& self) {
        add = self.output("after").command("add");
        amount = add.argument<double>("amount");
    };
    sender.onActive = [&](Probe&, const Tick&) { sent = add.send(); };
    receiver.onAdd = [&](Probe& self, Call& call) {
        executed.push_back(call[self.amount]);
        return Outcome::Done;
    };
    cluster.start();
    cluster.startup(receiver);
    cluster.startup(sender);

    cluster.step(3);
    EXPECT_EQ(sent, Outcome::Rejected);
    EXPECT_EQ(add.answer().why.view(), "'amount' has no default and was never set");
    amount += 1;  // counts what was never set
    cluster.step();
    EXPECT_EQ(sent, Outcome::Rejected);
    EXPECT_TRUE(executed.empty());
    EXPECT_EQ(add.sent(), 0U);
    const std::vector<std::string> events = cluster.events();
    EXPECT_EQ(std::ranges::count(
                  events, "/a: add to /b: 'amount' has no default and was never set, not sent"),
              1);

    amount = 0;
    cluster.step();
    EXPECT_EQ(sent, Outcome::None);
    EXPECT_EQ(executed, std::vector<double>{0});
}

TEST(WhatMayBeWritten, LeavesTheItemsOfTheFrameworkOutAlreadyAtTheStart) {
    ProbeCluster cluster;
    for (const char* path : {"/a", "/b"}) {
        cluster.probe(path).onPopulate = [](Probe& self) { self.data<std::int64_t>("state") = 2; };
    }
    cluster.probe("/long", "LongProbe").onPopulate = [](Probe& self) {
        self.data<double>("progress") = 0.5;  // its own
        self.data<std::string_view>("requester") = "me";
    };

    const std::string refusal = refusalOf([&] { cluster.start(); });

    EXPECT_TRUE(contains(refusal, "/a: /a.state is written by the framework") ||
                contains(refusal, "/a.state is written by the framework"))
        << refusal;
    EXPECT_TRUE(contains(refusal, "/b.state is written by the framework")) << refusal;
    EXPECT_TRUE(contains(refusal, "/long.requester is written by the framework")) << refusal;
}

TEST(WhatMayBeWritten, IsNothingForTheProgramWhileAClockRunsTheLoop) {
    ProbeCluster cluster;
    Simplex& signal = cluster.tree.add("/signal", "Signal");
    cluster.cluster->setTriggerSource<cs::InternalClock>(1ms);
    cluster.start();

    EXPECT_EQ(signal.data<const double>("value").get(), 0);
    EXPECT_TRUE(contains(refusalOf([&] { signal.data<double>("value"); }),
                         "/signal.value: the loop runs; a program sends the command `set`"));
}

TEST(FaultCodes, ThatAreNotAboveZeroAreRefusedAndFaultAllTheSame) {
    for (const std::int64_t code : {0, -5}) {
        ProbeCluster cluster;
        cluster.probe("/a").onActive = [&](Probe& self, const Tick&) {
            self.fault(code, "no pressure");
        };
        cluster.start();
        cluster.call("/a", "startup");
        cluster.step(3);

        EXPECT_EQ(cluster.state("/a"), State::Fault);
        EXPECT_EQ(cluster.integer("/a", "faultCode"), -1);
        EXPECT_TRUE(cluster.hasEvent("fault code " + std::to_string(code) +
                                     " is not above 0, as a simplex's own are: no pressure"));
    }
}

TEST(CallsOfTheClusterInAHook, AreRefusedAtOnce) {
    ProbeCluster cluster;
    std::string call, stop, start;
    cluster.probe("/a").onLoopStart = [&](Probe&, const Tick&) {
        call = refusalOf([&] { cluster.cluster->call("/a", "poke"); });
        stop = refusalOf([&] { cluster.cluster->stop(); });
        start = refusalOf([&] { cluster.cluster->start(); });
    };
    cluster.start();
    cluster.step();

    EXPECT_TRUE(contains(call, "call() was called in a hook")) << call;
    EXPECT_TRUE(contains(call, "CommandSender")) << call;
    EXPECT_TRUE(contains(stop, "stop() was called in a hook")) << stop;
    EXPECT_TRUE(contains(start, "start() was called in a hook")) << start;
    EXPECT_TRUE(cluster.cluster->running());
}

}  // namespace

}  // namespace cortex::test
