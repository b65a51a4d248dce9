// SPDX-License-Identifier: Apache-2.0
// The views of drives can be read: in three themes, in sizes of a page and in both fonts. With
// CORTEX_PICTURES=FOLDER it writes what it has seen there.
#include "drive/axis_numbers.hpp"
#include "drive/fieldbus_view.hpp"
#include "drive/word_table.hpp"
#include "gui/audit.hpp"
#include "gui/audit_texts.hpp"
#include "gui/drive_fixture.hpp"
#include "style/look.hpp"

#include <QApplication>
#include <QDir>
#include <QScrollArea>

namespace cortex::test {
namespace {

using gui::Look;
using gui::Theme;

// What a page has below header and tabs: in the usual window, and in the smallest one. No theme has
// other sizes.
struct AuditedPage {
    Theme theme;
    int width, height;
    double scale;
};
constexpr std::array auditedPages{
    AuditedPage{Theme::Light, 975, 570, 1}, AuditedPage{Theme::Light, 800, 350, 1},
    AuditedPage{Theme::Light, 800, 250, 1.5}, AuditedPage{Theme::Dark, 975, 570, 1},
    AuditedPage{Theme::HighContrast, 975, 570, 1}};

class AuditedDrives : public DriveRig {
protected:
    ~AuditedDrives() override { Look::apply(Theme::Light, 1, QStringLiteral("Open Sans")); }
    void audit(QWidget& page, const QString& name, const char* family,
               const std::function<void()>& again) {
        for (const AuditedPage& at : auditedPages) {
            Look::apply(at.theme, at.scale, QLatin1String{family});
            page.resize(at.width, at.height);
            for (int i = 0; i < 3; ++i) {
                again();
                QApplication::processEvents();  // what is laid out lays out more
            }
            const QString of = QStringLiteral("%1-%2-%3-%4")
                                   .arg(name, gui::themeName(at.theme))
                                   .arg(at.width)
                                   .arg(at.scale);
            const QStringList found = unreadableIn(page);
            EXPECT_TRUE(found.isEmpty())
                << of.toStdString() << ", " << family << ": " << found.join("\n").toStdString();
            paintedWhole(page);
            nothingIsCutAtTheSide(page);
            const QString pictures = qEnvironmentVariable("CORTEX_PICTURES");
            if (!pictures.isEmpty()) page.grab().save(QDir{pictures}.filePath(of + ".png"));
        }
    }
    // It is scrolled up and down only.
    static void nothingIsCutAtTheSide(QWidget& page) {
        for (auto* each : page.findChildren<QScrollArea*>())
            EXPECT_LE(each->widget()->minimumSizeHint().width(), each->viewport()->width());
    }
    // What is painted lies in its widget, and no text of it on another.
    static void paintedWhole(QWidget& page) {
        std::vector<QWidget*> painted;
        for (auto* each : page.findChildren<explorer::StateDiagram*>()) painted.push_back(each);
        for (auto* each : page.findChildren<explorer::WordTable*>()) painted.push_back(each);
        for (auto* each : page.findChildren<explorer::AxisNumbers*>()) painted.push_back(each);
        for (QWidget* each : painted) {
            if (!each->isVisible()) continue;
            const auto texts = paintedTexts(*each);
            for (std::size_t i = 0; i < texts.size(); ++i) {
                EXPECT_TRUE(each->rect().contains(texts[i].box))
                    << texts[i].text.toStdString() << " in " << each->width() << 'x'
                    << each->height();
                for (std::size_t j = i + 1; j < texts.size(); ++j)
                    EXPECT_FALSE(texts[i]
                                     .box.adjusted(0, 2, 0, -2)
                                     .intersects(texts[j].box.adjusted(0, 2, 0, -2)))
                        << texts[i].text.toStdString() << " over " << texts[j].text.toStdString();
            }
        }
    }
    void auditAxes(const QString& name, const char* family) {
        audit(view, name, family, [this] { show(); });
    }
};

TEST_F(AuditedDrives, AnEnabledAxisAndOneThatIsHomed) {
    putTexts("/table/processor", "activity", {"home"});
    putTexts("/table/processor", "requester", {"cortex-explorer@desk.4711"});
    put("/table/processor", "outcome", 2);
    put("/table/processor", "progress", 0.58);
    put(drive(2), "modeDisplay", 6);
    put(target(2), "controlWord", 0x1F);
    for (const int axis : {1, 2}) {
        put(drive(axis), "position", -2.9999);
        put(drive(axis), "velocity", 0.4);
        put(drive(axis), "effort", -19.5);
        put(target(axis), "position", 1.25);
    }
    auditAxes("enabled", "Open Sans");
}

TEST_F(AuditedDrives, AFaultAndALostDrive) {
    put(1, Ds402State::Fault);
    put(drive(1), "statusWord", 0x2298);
    put(drive(1), "errorCode", 0x8611);
    put("/table/processor", "errorCode", 0x8611);
    putTexts("/table/processor", "errorText", {"following error of 0.052 rad, allowed 0.050", ""});
    robot.degrade(drive(2), Quality::Lost);
    robot.degrade(target(2), Quality::Lost);
    put("/table/drive", "link", 3);
    host.answer = {false, "Rejected (state): axis 1 is in Fault; reset it first  12:04:07.123", {}};
    action(1, "resetFault").click();
    auditAxes("fault", "DejaVu Sans");
    auditAxes("fault-open", "Open Sans");
}

TEST_F(AuditedDrives, WithoutControl) {
    controls = false;
    auditAxes("read-only", "Open Sans");
}

TEST_F(AuditedDrives, TheLinkOfADevice) {
    explorer::FieldbusView link{"/table/drive"};
    link.setHost(&host);
    link.show();
    put("/table/drive", "age", 61.0);
    put("/table/drive", "link", 0);
    audit(link, "link", "DejaVu Sans", [&] {
        show();
        link.refresh(explorer::SystemNow{*host.frame});
    });
}

}  // namespace
}  // namespace cortex::test
