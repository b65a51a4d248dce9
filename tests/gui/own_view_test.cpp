// SPDX-License-Identifier: Apache-2.0
// Views of plug-ins in the window, with a real agent over DDS.
#include "gui/window_fixture.hpp"
#include "widgets/text_label.hpp"

#include <QLabel>
#include <QTabBar>

namespace cortex::test {
namespace {

class OwnViews : public Window {
protected:
    QString said() {
        const auto* label = window.current()->findChild<QLabel*>("said");
        return label == nullptr ? QString{} : label->text();
    }
    bool anyLabelSays(const QString& text) {
        for (const auto* label : window.current()->findChildren<TextLabel*>()) {
            if (label->isVisible() && label->text().contains(text)) return true;
        }
        return false;
    }
    QTabBar& tabs() { return *window.current()->findChild<QTabBar*>(); }
};

TEST_F(OwnViews, AViewOfAPlugInIsTheFirstTabAndKnowsValuesAndRelationships) {
    ASSERT_TRUE(everythingComes());
    window.open("/drive");
    EXPECT_TRUE(comes([this] { return said() == "[0.5000]rad|live|Standby|1|/drive|—|—"; }))
        << said().toStdString();
    EXPECT_EQ(tabs().tabText(tabs().currentIndex()), "All");
    EXPECT_EQ(live({"call", "/drive", "startup"}).exit, 0);
    EXPECT_TRUE(comes([this] { return said().contains("|live|Active|"); })) << said().toStdString();
}

TEST_F(OwnViews, ASimplexWithoutOneShowsItsData) {
    ASSERT_TRUE(everythingComes());
    window.open("/drive");
    EXPECT_TRUE(comes([this] { return !said().isEmpty(); }));
    window.open("/axis/observed");
    EXPECT_TRUE(comes([this] { return tabs().currentIndex() == 1; }));
    EXPECT_FALSE(tabs().isTabVisible(0));
    window.open("/drive");
    EXPECT_TRUE(comes([this] { return tabs().currentIndex() == 0; }));
}

TEST_F(OwnViews, OneThatThrowsIsClosedWithWhatItThrew) {
    ASSERT_TRUE(everythingComes());
    window.open("/controller");
    EXPECT_TRUE(comes([this] { return anyLabelSays("it threw “out of paper”"); }));
}

}  // namespace
}  // namespace cortex::test
