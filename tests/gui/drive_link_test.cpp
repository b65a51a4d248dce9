// SPDX-License-Identifier: Apache-2.0
// The view of the link of a device behind a bus.
#include "cortex/explorer/small_plot.hpp"

#include "drive/fieldbus_view.hpp"
#include "drive/link_row.hpp"
#include "gui/drive_fixture.hpp"

namespace cortex::test {
namespace {

using explorer::FieldbusView;

class LinkOfADevice : public DriveRig {
protected:
    LinkOfADevice() {
        link.setHost(&host);
        link.resize(975, 420);
        link.show();
        put("/table/drive", "age", 3.1);
        put("/table/drive", "exchangeCount", 12004);
        put("/table/drive", "lateCount", 14);
        put("/table/drive", "errorCount", 2);
        put("/table/drive", "reconnectCount", 1);
        put("/table/drive", "exchangeTimeP99", 3800.0);
    }
    QString said(const std::string& agent = "running") {
        show(agent);
        link.refresh(explorer::SystemNow{*host.frame});
        return saidIn(link);
    }
    FieldbusView link{"/table/drive"};
};

TEST_F(LinkOfADevice, IsAWordWithItsAgeAndWhatWentWrong) {
    EXPECT_TRUE(said().startsWith(
        "Link open|last answer 3.1 ms ago, of 50 ms   14 late   2 errors   1 reconnects   "
        "P99 3800 µs"))
        << said().toStdString();
    for (const auto& [number, word] :
         {std::pair{0, "Link closed|"}, {1, "Link connecting|"}, {3, "Link refused|"}}) {
        put("/table/drive", "link", number);
        EXPECT_TRUE(said().startsWith(word)) << said().toStdString();
    }
    EXPECT_TRUE(said().contains("12004 exchanges were answered.")) << said().toStdString();
}

TEST_F(LinkOfADevice, StandsAboveTheAxesOfItsProcessorOnce) {
    EXPECT_TRUE(!said().isEmpty());
    EXPECT_EQ(view.findChildren<explorer::LinkRow*>().size(), 1);
    EXPECT_TRUE(saidIn(view).contains("Link open|"));
}

TEST_F(LinkOfADevice, IsOpenedAnewByItsButton) {
    said();
    EXPECT_EQ(sends(link.link().button()), "/table/drive reconnect");
    EXPECT_TRUE(saidIn(link).contains("Reconnect: Done")) << saidIn(link).toStdString();
    controls = false;
    said();
    EXPECT_EQ(link.link().button().accessibleDescription(), "read-only: take control of /table");
    EXPECT_FALSE(link.link().button().isEnabled());
}

TEST_F(LinkOfADevice, OfALostAgentIsInBrackets) {
    EXPECT_TRUE(said("lost").startsWith("[Link open]|last answer [3.1] ms ago"))
        << said("lost").toStdString();
    EXPECT_FALSE(link.link().button().isEnabled());
}

}  // namespace
}  // namespace cortex::test
