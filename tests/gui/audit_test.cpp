// SPDX-License-Identifier: Apache-2.0
// Every view of the window can be read: in three themes, three sizes, two fonts, and in a language
// that is 40 % longer.
#include "gui/audit.hpp"

#include "gui/window_fixture.hpp"
#include "model/shown_time.hpp"
#include "plots/plot_view.hpp"
#include "session/utc_now.hpp"
#include "style/look.hpp"
#include "views/compare_view.hpp"
#include "views/fault_history_view.hpp"
#include "views/manual_view.hpp"
#include "widgets/item_drag.hpp"
#include "window/control_bar.hpp"
#include "window/workspace.hpp"

#include <QDragEnterEvent>
#include <QPushButton>
#include <QTabBar>
#include <QTranslator>
#include <array>
#include <memory>

#include <gtest/gtest.h>

namespace cortex::test {
namespace {

using namespace cortex::gui;

struct Size {
    int width, height;
    double scale;
};
constexpr std::array sizes{Size{1280, 800, 1}, Size{1024, 768, 1.25}, Size{800, 600, 1.5}};

// Texts of the program with accents and 40 % more letters; those of agents stay as they are.
class LongLanguage : public QTranslator {
public:
    LongLanguage() { QCoreApplication::installTranslator(this); }
    ~LongLanguage() override { QCoreApplication::removeTranslator(this); }
    bool isEmpty() const override { return false; }
    QString translate(const char* /*context*/, const char* source, const char* /*comment*/,
                      int /*n*/) const override {
        QString text = QString::fromUtf8(source);
        text.replace('a', QChar{0xe1}).replace('e', QChar{0xe9}).replace('o', QChar{0xf6});
        return text + QString{text.size() * 2 / 5, '~'};
    }
};

// Opens each view and gives its name.
struct View {
    const char* name;
    void (*open)(MainWindow& window);
};
// The page of agents with one of the tabs below the table.
void openAgents(MainWindow& window, int tab) {
    window.openKind("agents");
    window.current()->findChild<QTabBar*>()->setCurrentIndex(tab);
}

const std::array views{
    View{"overview", [](MainWindow& window) { window.openKind("overview"); }},
    View{"data",
         [](MainWindow& window) {
             window.open("/drive");
             window.openPart("data");
         }},
    View{"data in degrees",
         [](MainWindow& window) {
             window.workspace().units().choose(ShownUnits::restored({"deg", "mm"}));
         }},
    View{"relationships", [](MainWindow& window) { window.openPart("relationships"); }},
    View{"commands", [](MainWindow& window) { window.openPart("commands"); }},
    View{"type", [](MainWindow& window) { window.openPart("type"); }},
    View{"system", [](MainWindow& window) { window.openKind("system"); }},
    View{"loop", [](MainWindow& window) { openAgents(window, 0); }},
    View{"last ten minutes", [](MainWindow& window) { openAgents(window, 1); }},
    View{"leases", [](MainWindow& window) { openAgents(window, 2); }},
    View{"agreement", [](MainWindow& window) { openAgents(window, 3); }},
    View{"events", [](MainWindow& window) { window.openKind("events"); }},
    View{"before a fault",
         [](MainWindow& window) {
             static const std::int64_t now = utcNow();
             comms::AgentEvent fault;
             fault.agent = "mixer";
             fault.wallClock = now;
             fault.kind = "fault";
             fault.severity = Severity::Error;
             fault.path = "/drive";
             fault.text = "fault 7: the axis does not follow its demand";
             window.workspace().openBefore(fault);
             const auto* view = qobject_cast<FaultHistoryView*>(window.current());
             EXPECT_TRUE(comes([&] { return view->settled(); }));
         }},
    View{"compare",
         [](MainWindow& window) {
             window.openKind("compare");
             qobject_cast<CompareView*>(window.current())->compare("position");
         }},
    View{"empty plot", [](MainWindow& window) { window.openPlot({}); }},
    View{"plot",
         [](MainWindow& window) {
             window.openPlot({{{}, "/drive", "position", 0}, {{}, "/drive", "state", 0}});
         }},
    View{"plot in degrees and local time",
         [](MainWindow& window) {
             window.workspace().units().choose(ShownUnits::restored({"deg", "mm"}));
             showLocalTime(true);
         }},
    View{"second plot, with a place for what is dragged",
         [](MainWindow& window) {
             showLocalTime(false);
             window.workspace().newPlot({{{}, "/axis/observed", "position", 0}});
             window.refresh();
             auto* plot = qobject_cast<PlotView*>(window.current());
             const std::unique_ptr<QMimeData> data{mimeOf({{{}, "/axis/observed", "velocity", 0}})};
             const QPoint at = plot->rect().center();
             QDragEnterEvent enter{at, Qt::CopyAction, data.get(), Qt::LeftButton, {}};
             QApplication::sendEvent(plot, &enter);
         }},
    View{"manual", [](MainWindow& window) { window.openManual(); }},
};

std::string findingsOf(MainWindow& window, const Size& size) {
    window.resize(size.width, size.height);
    std::string findings;
    for (const View& view : views) {
        view.open(window);
        window.refresh();
        for (int i = 0; i < 3; ++i)
            QApplication::processEvents();  // what is laid out lays out more
        for (const QString& each : unreadableIn(window)) {
            findings += std::string{view.name} + " at " + std::to_string(size.width) + ": " +
                        each.toStdString() + '\n';
        }
    }
    return findings;
}

struct Audited : Window {
    ~Audited() override { Look::apply(Theme::Light, 1, QStringLiteral("Open Sans")); }
};

TEST_F(Audited, EveryViewCanBeReadInEveryThemeSizeAndFont) {
    ASSERT_TRUE(everythingComes());
    for (const Theme theme : allThemes) {
        for (const Size& size : sizes) {
            for (const char* family : {"Open Sans", "DejaVu Sans"}) {
                Look::apply(theme, size.scale, QLatin1String{family});
                EXPECT_EQ(findingsOf(window, size), "")
                    << family << ", " << themeName(theme).toStdString();
            }
        }
    }
}

struct AuditedInALongLanguage : LongLanguage, Audited {};

TEST_F(AuditedInALongLanguage, EveryViewCanBeRead) {
    ASSERT_TRUE(everythingComes());
    for (const Size& size : sizes) {
        Look::apply(Theme::Light, size.scale, QStringLiteral("Open Sans"));
        EXPECT_EQ(findingsOf(window, size), "");
    }
}

TEST(Audit, FindsWhatCannotBeRead) {
    QWidget window;
    window.resize(200, 100);
    auto* cut = new QPushButton{QStringLiteral("A text that is too long for it"), &window};
    cut->setGeometry(0, 0, 40, 30);
    auto* over = new QPushButton{QStringLiteral("B"), &window};
    over->setGeometry(20, 10, 40, 30);
    window.show();
    const QString found = unreadableIn(window).join('\n');
    EXPECT_TRUE(found.contains("\"A text that is too long for it\" is cut")) << found.toStdString();
    EXPECT_TRUE(found.contains("lies over \"B\"")) << found.toStdString();
}

}  // namespace
}  // namespace cortex::test
