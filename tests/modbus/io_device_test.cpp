// SPDX-License-Identifier: Apache-2.0
// A coupler of XML alone, against a server of libmodbus. A cycle of the loop, which is stepped, is
// a second, and an answer has all the time that there is: no time of the machine decides anything.
#include "cortex/core/agent.hpp"
#include "cortex/core/error.hpp"
#include "cortex/cs/testing.hpp"

#include "modbus/test_servers.hpp"
#include "modbus_io_device.hpp"
#include "support/waiting.hpp"

#include <algorithm>
#include <memory>
#include <mutex>
#include <string>
#include <utility>
#include <vector>

#include <gtest/gtest.h>
#include <modbus/modbus.h>

namespace cortex::modbus::test {
namespace {

using namespace std::chrono_literals;
using Pairs = cs::TestPlant::Pairs;
using toolkit::Link;

std::string repeated(const std::string& first, const std::string& rest) {
    std::string text = first;
    const auto given = static_cast<std::size_t>(std::ranges::count(first, ' ')) + 1;
    for (std::size_t i = given; i < mostPlaces; ++i) text += " " + rest;
    return text;
}

class CouplerPlant : public cs::TestPlant {
public:
    explicit CouplerPlant(const std::string& address, const Pairs& settings = {},
                          const std::string& fans = "Fans")
        : TestPlant{{CORTEX_SOURCE_DIR "/tests/data/modbus-rules.xml"}, 1s} {
        classes().add<ModbusIoDevice>("ModbusIoDevice");
        add("/valves", "Valves", {}, {{"count", "3"}});
        add("/fans", fans, {},
            {{"count", "2"},
             {"scale", repeated("0.5 0.001", "1")},
             {"offset", repeated("0 -2", "0")}});
        add("/buttons", "DigitalInputGroup", {}, {{"count", "10"}});
        add("/levels", "AnalogueInputGroup", {},
            {{"count", "2"}, {"scale", repeated("0.1", "1")}, {"offset", repeated("-5", "0")}});
        Pairs all{
            {"address", address},       {"exchangePeriod", "0.001"}, {"responseTimeout", "0.7"},
            {"lossTime", "40"},         {"reconnectTime", "0.01"},   {"coilsAt", "10"},
            {"discreteInputsAt", "20"}, {"inputRegistersAt", "30"},  {"holdingRegistersAt", "40"}};
        for (const auto& [item, value] : settings) {
            std::erase_if(all, [&](const auto& each) { return each.first == item; });
            all.emplace_back(item, value);
        }
        add("/coupler", "ModbusIoDevice",
            {{"digitalOutputs", "/valves"},
             {"analogueOutputs", "/fans"},
             {"digitalInputs", "/buttons"},
             {"analogueInputs", "/levels"}},
            all);
    }
    void start() {
        cluster().addEventSink([events = events_](const Event& event, const Structure&) {
            const std::lock_guard lock{events->mutex};
            events->text += std::string{event.text.view()} + "\n";
        });
        TestPlant::start();
    }
    std::string events() {
        cluster().agent().events().flush();
        const std::lock_guard lock{events_->mutex};
        return events_->text;
    }
    void stepUntil(const std::string& what, const std::function<bool()>& condition) {
        cortex::test::waitUntil(
            what, [&] { return condition() || (step(), false); }, [this] { return events(); });
    }
    Quality quality(const std::string& path) {
        const Image image = cluster().image();
        return image.state(image.structure().find(path)).quality;
    }
    Link link() { return static_cast<Link>(get<std::int64_t>("/coupler", "link")); }
    bool isGood() { return quality("/levels") == Quality::Good; }
    std::vector<double> levels() {
        return std::get<std::vector<double>>(cluster().image().value("/levels", "value"));
    }
    std::vector<bool> buttons() {
        return std::get<std::vector<bool>>(cluster().image().value("/buttons", "value"));
    }
    void demand(std::vector<bool> valves, std::vector<double> fans) {
        auto toValves = tree().at("/valves").array<bool>("value");
        for (std::size_t i = 0; i < valves.size(); ++i) toValves[i] = valves[i];
        std::ranges::copy(fans, tree().at("/fans").array<double>("value").begin());
    }
    std::size_t count(const std::string& text) {
        const std::string all = events();
        std::size_t found = 0;
        for (std::size_t at = all.find(text); at != std::string::npos; at = all.find(text, at + 1))
            ++found;
        return found;
    }

private:
    struct Events {
        std::mutex mutex;
        std::string text;
    };
    std::shared_ptr<Events> events_ = std::make_shared<Events>();  // outlives the plant's end
};

class ModbusIo : public testing::Test {
protected:
    void setInputs(std::vector<std::uint8_t> bits, std::vector<std::uint16_t> words) {
        server.look([&](modbus_mapping_t& map) {
            std::ranges::copy(bits, map.tab_input_bits + 20);
            std::ranges::copy(words, map.tab_input_registers + 30);
        });
    }
    // What stands in the coils and registers of the coupler.
    std::string outputs(std::size_t registers = 2) {
        return server.look([&](modbus_mapping_t& map) {
            std::string text;
            for (int i = 10; i < 13; ++i) text += map.tab_bits[i] != 0 ? '1' : '0';
            for (std::size_t i = 40; i < 40 + registers; ++i)
                text += " " + std::to_string(map.tab_registers[i]);
            return text;
        });
    }
    void expectOutputs(CouplerPlant& plant, const std::string& wanted, std::size_t registers = 2) {
        plant.stepUntil("outputs " + wanted, [&] { return outputs(registers) == wanted; });
    }

    ModbusServer server;
};

TEST_F(ModbusIo, OfXmlAloneCarriesItsValuesBothWays) {
    setInputs({1, 0, 0, 1, 1, 0, 0, 0, 0, 1}, {100, 0xFFFF});
    CouplerPlant plant{server.address()};
    plant.start();
    EXPECT_EQ(plant.quality("/levels"), Quality::Lost) << "before the first answer";
    plant.stepUntil("good inputs", [&] { return plant.isGood(); });
    EXPECT_EQ(plant.state("/coupler"), State::Standby) << "it measures in every state";
    plant.startUp();
    plant.demand({true, false, true}, {10, -1.5});

    expectOutputs(plant, "101 20 500");
    plant.stepUntil("good inputs again", [&] { return plant.isGood(); });

    EXPECT_EQ(plant.quality("/buttons"), Quality::Good);
    EXPECT_EQ(plant.link(), Link::Open);
    EXPECT_EQ(plant.levels()[0], -5 + 0.1 * 100);
    EXPECT_EQ(plant.levels()[1], -1) << "signed, unless it is said otherwise";
    EXPECT_EQ(plant.levels()[2], 0);
    std::vector<bool> buttons(32);
    for (const std::size_t i : {0U, 3U, 4U, 9U}) buttons[i] = true;
    EXPECT_EQ(plant.buttons(), buttons);

    plant.demand({false, true, true}, {-10, -2});
    expectOutputs(plant, "011 65516 0");
    setInputs({0, 1}, {50, 7});
    plant.stepUntil("new inputs", [&] { return plant.levels()[1] == 7 && plant.buttons()[1]; });
    EXPECT_EQ(plant.levels()[0], 0);
    EXPECT_TRUE(plant.buttons()[1]);
}

TEST_F(ModbusIo, GivesSafeValuesUnlessItIsActiveWhereNoSimplexWritesThem) {
    CouplerPlant plant{server.address()};
    plant.start();
    plant.demand({true, false, true}, {10, 5});
    plant.step(3);
    expectOutputs(plant, "010 3 0");
    EXPECT_EQ(plant.quality("/fans"), Quality::Stale) << "it shows what does not go out";

    plant.startUp();
    expectOutputs(plant, "101 20 7000");
    EXPECT_EQ(plant.quality("/fans"), Quality::Good);
    EXPECT_TRUE(plant.call("/coupler", "shutdown").done());
    expectOutputs(plant, "010 3 0");
    EXPECT_EQ(plant.quality("/fans"), Quality::Stale);
}

TEST_F(ModbusIo, ReadsItsInputsFromHoldingRegistersWhereTheyStandThere) {
    server.look([](modbus_mapping_t& map) {
        map.tab_registers[50] = 100;
        map.tab_registers[51] = 7;
    });
    CouplerPlant plant{server.address(), {{"inputRegistersAt", "-1"}, {"holdingInputsAt", "50"}}};
    plant.start();
    plant.stepUntil("good inputs", [&] { return plant.isGood(); });
    EXPECT_EQ(plant.levels()[0], -5 + 0.1 * 100);
    EXPECT_EQ(plant.levels()[1], 7);
    const Bytes request = server.requests()[1];
    EXPECT_EQ(hex({request.begin() + 7, request.end()}), "03 00 32 00 02");
}

TEST_F(ModbusIo, HasRegistersInTheFormatAndOrderOfItsItems) {
    setInputs({}, {0x0000, 0x3FC0, 0x0000, 0xC120});  // 1.5 and -10, low words first
    CouplerPlant plant{server.address(),
                       {{"registerFormat", "Float32"}, {"wordOrder", "LowWordFirst"}}};
    plant.start();
    plant.startUp();
    plant.demand({}, {0.75, -2});

    expectOutputs(plant, "000 0 16320 0 0", 4);  // 3FC0'0000: 1.5 counts of 0.5
    plant.stepUntil("good inputs", [&] { return plant.isGood(); });

    EXPECT_EQ(plant.levels()[0], -5 + 0.1 * 1.5);
    EXPECT_EQ(plant.levels()[1], -10);
}

TEST_F(ModbusIo, ReadsBeforeItWritesForTheFirstTime) {
    CouplerPlant plant{server.address()};
    plant.start();
    server.waitForRequests(6);
    std::vector<int> functions;
    for (const Bytes& each : server.requests()) functions.push_back(each[7]);
    functions.resize(6);
    EXPECT_EQ(functions, (std::vector{2, 4, 2, 4, 15, 16})) << "the first exchange only reads";
}

TEST_F(ModbusIo, HasItsTimeForEachExchangeAnew) {
    CouplerPlant plant{server.address(), {{"exchangePeriod", "0.8"}}};
    plant.start();
    std::int64_t connection = 0, before = 0;
    plant.stepUntil("two exchanges of one connection", [&] {
        const auto exchanges = plant.get<std::int64_t>("/coupler", "exchangeCount");
        const auto reconnects = plant.get<std::int64_t>("/coupler", "reconnectCount");
        if (std::exchange(connection, reconnects) != reconnects) before = exchanges;
        return exchanges >= before + 2;
    });
}

TEST_F(ModbusIo, ThatIsSwitchedOffLosesItsInputsAndComesBackByItself) {
    setInputs({1}, {100, 3});
    CouplerPlant plant{server.address()};
    plant.start();
    plant.demand({true, true, true}, {1, 0});
    plant.stepUntil("good inputs", [&] { return plant.isGood(); });

    server.leave();
    plant.stepUntil("lost inputs", [&] { return plant.quality("/levels") == Quality::Lost; });
    plant.stepUntil("a refused connection",
                    [&] { return plant.count("nobody listens there") > 0; });
    EXPECT_EQ(plant.levels()[1], 3) << "the last one, which its quality says";
    EXPECT_NE(plant.link(), Link::Open);
    EXPECT_EQ(plant.state("/coupler"), State::Standby) << "it is no fault";
    EXPECT_GT(plant.get<double>("/coupler", "age"), 0);

    setInputs({0}, {100, 4});
    server.comeBack();
    plant.stepUntil("new inputs", [&] { return plant.isGood() && plant.levels()[1] == 4; });
    EXPECT_GE(plant.get<std::int64_t>("/coupler", "reconnectCount"), 1);
    EXPECT_GE(plant.count("the device is back"), 1U);
}

TEST_F(ModbusIo, GivesSafeValuesWhileNobodySpeaksForItsOutputs) {
    CouplerPlant plant{server.address()};
    plant.start();
    plant.startUp();
    plant.demand({true, false, true}, {10, 5});
    expectOutputs(plant, "101 20 7000");

    plant.tree().at("/fans").slot().quality = Quality::Lost;
    expectOutputs(plant, "010 3 0");
    plant.tree().at("/fans").slot().quality = Quality::Good;
    expectOutputs(plant, "101 20 7000");
}

TEST_F(ModbusIo, GivesTheNearestOfWhatARegisterCannotHoldAndSaysSoOnce) {
    CouplerPlant plant{server.address()};
    plant.start();
    plant.startUp();
    plant.demand({}, {1e9, 0});
    expectOutputs(plant, "000 32767 2000");
    plant.step(5);
    EXPECT_EQ(plant.count("analogueOutputs: place 0 is 1e+09, which its register cannot hold; "
                          "it gets 16383.5"),
              1U)
        << plant.events();

    plant.demand({}, {-1e9, 0});
    expectOutputs(plant, "000 32768 2000");
    EXPECT_EQ(plant.count("cannot hold"), 1U) << "it is the same matter";
    plant.demand({}, {1, 0});
    expectOutputs(plant, "000 2 2000");
    plant.demand({}, {0, 40});
    expectOutputs(plant, "000 0 32767");
    EXPECT_EQ(plant.count("cannot hold"), 2U) << plant.events();
}

TEST_F(ModbusIo, WithOtherAddressesIsRefusedUntilTheyAreThere) {
    server.look([](modbus_mapping_t& map) { map.nb_input_registers = 31; });
    CouplerPlant plant{server.address()};
    plant.start();
    plant.demand({true, true, true}, {1, 0});
    plant.stepUntil("a refusal", [&] { return plant.link() == Link::Refused; });
    plant.stepUntil("its reason", [&] { return plant.count("illegal data address") > 0; });
    EXPECT_EQ(plant.quality("/levels"), Quality::Lost);
    EXPECT_EQ(outputs(), "000 0 0") << "nothing moves at a device that is another one";

    server.look([](modbus_mapping_t& map) { map.nb_input_registers = 100; });
    plant.stepUntil("good inputs", [&] { return plant.isGood(); });
    EXPECT_EQ(plant.link(), Link::Open);
}

std::string refusalOf(const Pairs& settings, const std::string& fans = "Fans") {
    CouplerPlant plant{"127.0.0.1:1", settings, fans};
    try {
        plant.start();
        return "";
    } catch (const std::exception& error) {
        return error.what();
    }
}

TEST(ModbusIoModel, ThatCannotStandIsRefusedInWords) {
    const std::vector<std::pair<Pairs, std::string>> cases{
        {{{"address", ""}}, "/coupler: address '' names no device"},
        {{{"address", "coupler"}}, "is no IP address"},
        {{{"unit", "250"}}, "/coupler: unit 250 is none of Modbus"},
        {{{"responseTimeout", "2"}}, "responseTimeout is longer than 0.7 s"},
        {{{"coilsAt", "-1"}},
         "/coupler: coilsAt is -1, but something is related by digitalOutputs or outputSignals; "
         "set the address at which it begins in the device"},
        {{{"coilsAt", "65534"}},
         "/coupler: coilsAt is 65534, and the 3 addresses of digitalOutputs or outputSignals would "
         "end beyond 65535"},
        {{{"registerFormat", "Signed32"}, {"holdingRegistersAt", "65533"}},
         "the 4 addresses of analogueOutputs or outputNumbers would end beyond 65535"},
        {{{"holdingInputsAt", "0"}}, "/coupler: inputRegistersAt and holdingInputsAt are both set"},
        {{{"inputRegistersAt", "-1"}, {"holdingInputsAt", "65535"}},
         "holdingInputsAt is 65535, and the 2 addresses of analogueInputs or inputNumbers"},
        {{{"registerFormat", "Unsigned16"}, {"inputRegistersAt", "65534"}}, ""},
    };
    for (const auto& [settings, words] : cases) {
        const std::string text = refusalOf(settings);
        if (words.empty())
            EXPECT_EQ(text, "");
        else
            EXPECT_NE(text.find(words), std::string::npos) << text;
    }
    EXPECT_NE(refusalOf({}, "HeldFans").find("/fans (HeldFans) has no safe value"),
              std::string::npos);
}

TEST(ModbusIoModel, OfAGroupThatDoesNotFitIsRefusedInWords) {
    const auto refusal = [](const Pairs& fans, const std::string& type = "AnalogueOutputGroup",
                            const Pairs& more = {}) -> std::string {
        cs::TestPlant plant{{CORTEX_SOURCE_DIR "/tests/data/modbus-rules.xml"}, 1s};
        plant.classes().add<ModbusIoDevice>("ModbusIoDevice");
        Pairs settings{{"address", "127.0.0.1:1"}, {"lossTime", "40"}};
        settings.insert(settings.end(), more.begin(), more.end());
        Pairs relates;
        if (!type.empty()) {
            plant.add("/fans", type, {}, fans);
            relates = {{"analogueOutputs", "/fans"}};
        }
        plant.add("/coupler", "ModbusIoDevice", relates, settings);
        try {
            plant.start();
            return "";
        } catch (const std::exception& error) {
            return error.what();
        }
    };
    const Pairs at{{"holdingRegistersAt", "0"}};
    EXPECT_EQ(refusal({}, "AnalogueOutputGroup", at), "");
    EXPECT_NE(refusal({{"count", "2"}, {"scale", repeated("1 0", "1")}}, "AnalogueOutputGroup", at)
                  .find("/fans (AnalogueOutputGroup) has the scale 0 at place 1 (from 0)"),
              std::string::npos);
    EXPECT_NE(refusal({{"scale", repeated("0.00001", "1")}}, "Fans", at)
                  .find("/fans (Fans) has the safe value 1.5 at place 0 (from 0), which the "
                        "register cannot hold"),
              std::string::npos);
    EXPECT_NE(refusal({}, "", at)
                  .find("holdingRegistersAt is 0, but nothing is related by analogueOutputs or "
                        "outputNumbers"),
              std::string::npos);
    EXPECT_NE(refusal({}, "").find("has neither inputs nor outputs"), std::string::npos);
}

}  // namespace
}  // namespace cortex::modbus::test
