// SPDX-License-Identifier: Apache-2.0
// The views of motion can be read: in three themes, in all sizes, fonts and units. With
// CORTEX_PICTURES=FOLDER it writes what it has seen there.
#include "gui/audit.hpp"
#include "gui/motion_fixture.hpp"
#include "style/look.hpp"

#include <QDir>
#include <array>

namespace cortex::test {
namespace {

struct Size {
    int width, height;
    double scale;
};
constexpr std::array sizes{Size{1280, 800, 1}, Size{1920, 1080, 1}, Size{1024, 768, 1.25},
                           Size{800, 600, 1}, Size{800, 600, 1.5}};

class AuditedMotion : public MotionWindow {
protected:
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
