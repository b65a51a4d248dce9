// SPDX-License-Identifier: Apache-2.0
// The views of motion can be read: in three themes, in all sizes, fonts and units. With
// CORTEX_PICTURES=FOLDER it writes what it has seen there.
#include "gui/audit.hpp"
#include "gui/motion_fixture.hpp"
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
           "<simplex path=\"/tip\" type=\"CartesianJogController\">" + axes + demands +
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
    for (const Qt::Key key : {Qt::Key_Right, Qt::Key_PageUp}) {
        for (const Qt::KeyboardModifier with : {Qt::NoModifier, Qt::ShiftModifier}) {
            QTest::keyPress(&pad, key, with);
            EXPECT_TRUE(comes([this] { return jogs(); })) << said().toStdString();
            QTest::keyRelease(&pad, key, with);
            EXPECT_TRUE(comes([this] { return !jogs(); }));
        }
    }
    QTest::keyPress(&pad, Qt::Key_Plus);
    EXPECT_TRUE(says("Jogging elbow at ")) << said().toStdString();
    EXPECT_TRUE(comes([this] { return jogs(); }));
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

}  // namespace
}  // namespace cortex::test
