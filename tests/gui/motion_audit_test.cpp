// SPDX-License-Identifier: Apache-2.0
// The views of motion can be read: in three themes, in all sizes, fonts and units. With
// CORTEX_PICTURES=FOLDER it writes what it has seen there.
#include "cortex/explorer/small_plot.hpp"

#include "gui/audit.hpp"
#include "gui/audit_texts.hpp"
#include "gui/motion_fixture.hpp"
#include "motion/axis_plots.hpp"
#include "motion/tip_pad.hpp"
#include "style/look.hpp"

#include <QDir>
#include <array>

namespace cortex::test {
namespace {

using explorer::tipElbow;
using explorer::TipPad;

struct Size {
    int width, height;
    double scale;
};
constexpr std::array sizes{Size{1280, 800, 1}, Size{1920, 1080, 1}, Size{1024, 768, 1.25},
                           Size{800, 600, 1}, Size{800, 600, 1.5}};

class AuditedMotion : public MotionWindow {
protected:
    using MotionWindow::MotionWindow;
    ~AuditedMotion() override { Look::apply(Theme::Light, 1, QStringLiteral("Open Sans")); }
    void audit(const QString& name, const char* family) {
        for (const Theme theme : allThemes) {
            for (const Size& size : sizes) {
                Look::apply(theme, size.scale, QLatin1String{family});
                window.resize(size.width, size.height);
                for (int i = 0; i < 5; ++i) {
                    window.refresh();
                    QApplication::processEvents();  // what is laid out lays out more
                }
                const QString at = QStringLiteral("%1-%2-%3x%4-%5")
                                       .arg(name, themeName(theme))
                                       .arg(size.width)
                                       .arg(size.height)
                                       .arg(size.scale);
                const QStringList found = unreadableIn(window);
                EXPECT_TRUE(found.isEmpty())
                    << at.toStdString() << ", " << family << ": " << found.join("\n").toStdString();
                const QString pictures = qEnvironmentVariable("CORTEX_PICTURES");
                if (!pictures.isEmpty()) window.grab().save(QDir{pictures}.filePath(at + ".png"));
            }
        }
    }
};

TEST_F(AuditedMotion, JoggingCanBeReadInEveryThemeAndSize) {
    ASSERT_NO_FATAL_FAILURE(opensInControl("/jog"));
    speed().setValue(30);
    named("deg").click();
    named("mm").click();
    rows().setFocus();
    QTest::keyClick(&rows(), Qt::Key_Down);
    QTest::keyPress(&rows(), Qt::Key_Left);
    ASSERT_TRUE(comes([this] { return saidOf(1).contains("at its lower limit"); }));
    QTest::keyRelease(&rows(), Qt::Key_Left);
    QTest::keyClick(&rows(), Qt::Key_Up);
    QTest::keyPress(&rows(), Qt::Key_Right);
    ASSERT_TRUE(comes([this] { return number("/arm/axes/1", "position") > 0.3; }));
    audit("jog", "Open Sans");
    QTest::keyRelease(&rows(), Qt::Key_Right);
    audit("jog-ended", "DejaVu Sans");
    window.openPart("data");
    audit("data", "Open Sans");
}

// An arm of seven axes, whose tip moves in all six directions, and whose elbow turns.
std::string arm() {
    std::string text =
        "<system name=\"robot\"><ontology file=\"plant.xml\"/>"
        "<morphology file=\"cortex-morphology.xml\"/><simplex path=\"/arm\" type=\"KukaLbr\"/>";
    const std::vector<std::string> start{"0", "0.6", "0", "-1.4", "0", "1.1", "0"};
    std::string axes, demands;
    for (std::size_t i = 0; i < start.size(); ++i) {
        const std::string name = std::to_string(i + 1);
        const std::string axis = "to=\"/arm/axes/" + name + "\"/>";
        const std::string demand = "to=\"/arm/demands/" + name + "\"/>";
        text += "<simplex path=\"/drives/" + name +
                "\" type=\"SimulatedAxis\"><relate rule=\"demand\" " + demand +
                "<relate rule=\"observation\" " + axis + "<set data=\"startPosition\" value=\"" +
                start[i] + "\"/></simplex>";
        axes += "<relate rule=\"axes\" " + axis;
        demands += "<relate rule=\"demands\" " + demand;
    }
    return text + "<simplex path=\"/frame\" type=\"CartesianObservation\"/>" +
           "<simplex path=\"/kinematics\" type=\"ForwardKinematics\">" + axes +
           "<relate rule=\"tip\" to=\"/frame\"/></simplex>" +
           "<simplex path=\"/tip\" type=\"CartesianJogController\">" + axes + demands + longHold +
           R"(</simplex><cluster name="robot" frequency="500" overflow="skip" control="open"/></system>)";
}

class AuditedTip : public AuditedMotion {
protected:
    AuditedTip()
        : AuditedMotion{R"(<ontology name="plant" version="1.0"><include file="robotics.xml"/>)"
                        R"(</ontology>)",
                        arm()} {
        axes = 7;
        jogger = "/tip";
    }
};

TEST_F(AuditedTip, JoggingOfATipCanBeReadInEveryThemeAndSize) {
    ASSERT_NO_FATAL_FAILURE(opens("/tip"));
    ASSERT_EQ(live({"call", "/kinematics", "startup"}).exit, 0);
    ASSERT_TRUE(takes("/"));
    QApplication::setActiveWindow(&window);
    TipPad& pad = *view().findChild<TipPad*>();
    ASSERT_TRUE(comes([&] { return pad.button(0, 1).isEnabled(); })) << said().toStdString();
    for (int motion = 0; motion <= tipElbow; ++motion)
        EXPECT_TRUE(pad.button(motion, 1).isVisible()) << motion;
    named("deg").click();
    named("mm").click();
    speed().setValue(40);
    pad.setFocus();
    const auto holds = [&](Qt::Key key, Qt::KeyboardModifier with, const char* words) {
        QTest::keyPress(&pad, key, with);
        EXPECT_TRUE(moves([&] { QTest::keyRelease(&pad, key, with); },
                          [&] { QTest::keyPress(&pad, key, with); },
                          [&] { return said().contains(words); }))
            << said().toStdString() << testing::PrintToString(endings);
    };
    for (const Qt::Key key : {Qt::Key_Right, Qt::Key_PageUp}) {
        for (const Qt::KeyboardModifier with : {Qt::NoModifier, Qt::ShiftModifier}) {
            holds(key, with, "");
            QTest::keyRelease(&pad, key, with);
            EXPECT_TRUE(comes([this] { return !jogs(); }));
        }
    }
    holds(Qt::Key_Plus, Qt::NoModifier, "Jogging elbow at ");
    audit("tip", "Open Sans");
    QTest::keyRelease(&pad, Qt::Key_Plus);
    audit("tip-ended", "DejaVu Sans");
}

TEST_F(AuditedMotion, ThePoseCanBeReadInEveryThemeAndSize) {
    ASSERT_NO_FATAL_FAILURE(opensInControl("/pose"));
    enter(0, "0.4");
    enter(1, "0.03");
    named("Move").click();
    ASSERT_TRUE(says("there in")) << said().toStdString();
    enter(0, "-0.5");
    audit("pose", "Open Sans");
    audit("pose-dejavu", "DejaVu Sans");
}

// Where a text is painted whole; nowhere: an empty box.
QRect placeOf(QWidget& widget, const QString& text) {
    for (const PaintedText& each : paintedTexts(widget)) {
        if (each.text == text) return each.box;
    }
    return {};
}

class MotionParts : public testing::TestWithParam<const char*> {
protected:
    MotionParts() { Look::apply(Theme::Light, 1, QLatin1String{GetParam()}); }
    ~MotionParts() override { Look::apply(Theme::Light, 1, QStringLiteral("Open Sans")); }
};

TEST_P(MotionParts, TitlesOfColumnsAreWholeAndStandApartInTheNarrowestRow) {
    explorer::MotionAxis axis;
    axis.name = "shoulder";
    AxisRows shown;
    shown.make({axis}, explorer::RowPart::Demand, true);
    for (const QString unit : {"rad", "mm"}) {
        const auto titled = [&](const char* name) { return QString{"%1 (%2)"}.arg(name, unit); };
        shown.setTitles(titled("Value"), titled("Target"), titled("Demand"));
        shown.resize(shown.minimumWidth(), 200);
        const QRect value = placeOf(shown, titled("Value")),
                    target = placeOf(shown, titled("Target"));
        const QRect demand = placeOf(shown, titled("Demand"));
        EXPECT_FALSE(value.isEmpty() || target.isEmpty() || demand.isEmpty()) << unit.toStdString();
        EXPECT_GE(target.left() - value.right(), explorer::units(1)) << unit.toStdString();
        EXPECT_GE(demand.left() - target.right(), explorer::units(1)) << unit.toStdString();
    }
}

TEST_P(MotionParts, ASmallPlotKeepsItsUnitAndTheNamesOfItsLines) {
    explorer::SmallPlot plot{"position", "rad"};
    plot.addLine("now");
    plot.addLine("target", true);
    plot.resize(plot.minimumSizeHint());
    const QRect head = placeOf(plot, "position (rad)"), target = placeOf(plot, "target");
    EXPECT_FALSE(head.isEmpty() || target.isEmpty());
    int names = 0;
    for (const PaintedText& each : paintedTexts(plot)) {
        names += each.text == "now" && each.box.left() > head.right() &&
                 each.box.right() < target.left() && each.box.intersects(plot.rect());
    }
    EXPECT_EQ(names, 1);
}

TEST_P(MotionParts, ALongTitleOfASmallPlotGivesWayBeforeItsUnit) {
    explorer::SmallPlot plot{"velocity of the carriage on the long rail", "mm/s"};
    plot.addLine("now");
    plot.resize(plot.minimumSizeHint());
    QString texts;
    for (const PaintedText& each : paintedTexts(plot)) {
        texts += each.text;
        EXPECT_TRUE(plot.rect().contains(each.box)) << each.text.toStdString();
    }
    EXPECT_TRUE(texts.contains("… (mm/s)")) << texts.toStdString();
}

TEST_P(MotionParts, ALongNameOfAnAxisIsCutWithAnEllipsisAndWidensNoPlot) {
    explorer::MotionAxis axis;
    axis.name = "gantry/left-hand-side/shoulder-rotation-drive";
    explorer::AxisPlots plots;
    plots.forget(1);
    plots.add({axis}, 1);
    plots.show(axis, 0, {}, {});
    EXPECT_LE(plots.minimumSizeHint().width(), explorer::units(60));
    plots.resize(plots.minimumSizeHint());
    plots.QWidget::show();
    const auto* title = plots.findChild<QLabel*>();
    EXPECT_TRUE(title->text().contains(QChar{0x2026})) << title->text().toStdString();
    EXPECT_TRUE(title->text().endsWith(", last 10 s")) << title->text().toStdString();
    EXPECT_EQ(title->toolTip(), axis.name + ", last 10 s");
    axis.name = "A2";
    plots.forget(1);
    plots.add({axis}, 1);
    plots.show(axis, 0, {}, {});
    EXPECT_EQ(title->text(), "A2, last 10 s");
}

INSTANTIATE_TEST_SUITE_P(Fonts, MotionParts, testing::Values("Open Sans", "DejaVu Sans"));

TEST_F(AuditedMotion, DemandsThatWereRefusedCanBeReadInEveryThemeAndSize) {
    ASSERT_NO_FATAL_FAILURE(opensInControl("/pose"));
    enter(0, "9");
    enter(1, "0.03");
    named("Move").click();
    ASSERT_TRUE(says("Rejected")) << said().toStdString();
    audit("refused", "Open Sans");
    audit("refused-dejavu", "DejaVu Sans");
}

}  // namespace
}  // namespace cortex::test
