// SPDX-License-Identifier: Apache-2.0
// The audit finds each fault that is put into a window without one.
#include "core/model_folder.hpp"
#include "gui/audit.hpp"
#include "gui/events_fixture.hpp"
#include "gui/made_agent.hpp"
#include "gui/window_fixture.hpp"
#include "style/look.hpp"
#include "views/event_table.hpp"
#include "views/lease_table.hpp"
#include "views/life_cycle_bar.hpp"
#include "views/simplex_header.hpp"
#include "widgets/rows.hpp"
#include "widgets/text_label.hpp"
#include "window/control_notice.hpp"
#include "window/stop_button.hpp"

#include <QHeaderView>
#include <QPushButton>
#include <QTabBar>
#include <QVBoxLayout>
#include <array>
#include <memory>

#include <gtest/gtest.h>

namespace cortex::test {
namespace {

using namespace gui;

TypeModel limitedJoints() {
    const ModelFolder folder;
    return TypeModel::load(
        folder.write("joints.xml",
                     "<ontology name='joints' version='1.0'><include file='base.xml'/>"
                     "<type name='Joint' extends='Concept'>"
                     "<data name='angle' kind='float' unit='rad' min='-320.125' max='2960.5'/>"
                     "<data name='mode' kind='int' settable='always' labels='0:KeepsLastDemand'/>"
                     "</type></ontology>"));
}

// What is never cut, whole.
struct GoodWindow : QWidget {
    explicit GoodWindow(Session& session) : commands{session}, stop{new StopButton{session}} {
        auto* rows = new QVBoxLayout{this};
        for (QWidget* each : std::initializer_list<QWidget*>{stop, &notice->place(), header, tabs,
                                                             items, events, leases})
            rows->addWidget(each);
        notice->setParent(this);
        notice->tell("2 of 5 in Standby, 11.0 s; Not reached: robot; 1 did not follow: /probe");
        header->show(*probes, *probes->find("/probe"));
        lifeCycle->show("/probe");
        for (const char* each : {"Data", "Relationships", "Commands"}) tabs->addTab(each);
        model.show("/joint");
        model.update(joints);
        events->setFixedHeight(120);
        fresh.add({eventOf(1, "state change", "/probe", "Standby -> Active", Severity::Warning)});
        new QTreeWidgetItem{
            leases,
            {"/manipulator", "explorer@host.12345-abcdef", "2026-11-27 13:29:02", "3 h 05 min"}};
        resize(1100, 900);
        show();
        refresh();
    }
    void refresh() {
        for (int i = 0; i < 3; ++i) {
            notice->show("Control of / was not taken. robot: a@b.12-34 holds /arm", "Take / again");
            header->refresh(*probes, *probes->find("/probe"));
            lifeCycle->refresh(*probes, *probes->find("/probe"));
            for (int column = 0; column < 4; ++column) growToFit(*leases, column);
            QApplication::processEvents();  // what is laid out lays out more
        }
    }
    TextLabel& label(const QString& text) {
        for (auto* each : findChildren<TextLabel*>()) {
            if (each->text().startsWith(text)) return *each;
        }
        throw std::runtime_error{"no such label"};
    }

    Commands commands;
    MadeAgent robot{"robot", [](SimplexTree& tree) { tree.add("/probe", "Probe"); }};
    MadeAgent arm{"arm", [](SimplexTree& tree) { tree.add("/joint", "Joint"); }, limitedJoints()};
    std::shared_ptr<Frame> probes = frameOf({robot.now()}), joints = frameOf({arm.now()});
    StateTimes times;
    EventModel fresh;
    EventFilter filter{fresh};
    ItemModel model;
    StopButton* stop;
    ControlNotice* notice = new ControlNotice;
    LifeCycleBar* lifeCycle = new LifeCycleBar{commands};
    SimplexHeader* header = new SimplexHeader{lifeCycle, times};
    QTabBar* tabs = new QTabBar;
    ItemTable* items = new ItemTable{model};
    EventTable* events = new EventTable{filter};
    LeaseTable* leases = new LeaseTable;
};

// A column that has a pixel less than a text needs.
void narrow(QHeaderView& header, int column, const QString& text, int margins,
            bool strong = false) {
    header.resizeSection(column, textWidth(text, strong) - 2 + margins);
}

struct Mutation {
    const char* name;
    void (*mutate)(GoodWindow& window);
    const char* finding;
};

const std::array mutations{
    Mutation{"TimeOfAnEventCut",
             [](GoodWindow& window) {
                 narrow(*window.events->horizontalHeader(), EventModel::Time, "00:00:00.001",
                        Look::units(3));
             },
             "\"00:00:00.001\" is never to be cut"},
    Mutation{"SeverityCut",
             [](GoodWindow& window) {
                 narrow(*window.events->horizontalHeader(), EventModel::SeverityColumn, "warning",
                        Look::units(7.5));
             },
             "\"warning\" is never to be cut"},
    Mutation{"ColumnOutsideOfItsTable",
             [](GoodWindow& window) {
                 window.events->horizontalHeader()->resizeSection(EventModel::Agent, 1100);
                 window.events->horizontalHeader()->moveSection(EventModel::Time,
                                                                EventModel::Times);
             },
             "\"00:00:00.001\" is never to be cut"},
    Mutation{"LimitsLeftOut",
             [](GoodWindow& window) {
                 narrow(*window.items->header(), ItemModel::Range, QString::fromUtf8("−320.125"),
                        textWidth(QString::fromUtf8("−320.125")) + Look::units(24) - 2);
             },
             "320.125\" is never to be cut"},
    Mutation{"ValueCut",
             [](GoodWindow& window) {
                 narrow(*window.items->header(), ItemModel::Value, "KeepsLastDemand (0)",
                        Look::units(2));
             },
             "\"KeepsLastDemand (0)\" is never to be cut"},
    Mutation{"RemarkCut",
             [](GoodWindow& window) {
                 narrow(*window.items->header(), ItemModel::Remark, "settable", Look::units(4));
             },
             "\"settable\" is never to be cut"},
    Mutation{"HolderCut",
             [](GoodWindow& window) {
                 narrow(*window.leases->header(), 1, "explorer@host.12345-abcdef", Look::units(4));
             },
             "\"explorer@host.12345-abcdef\" is never to be cut"},
    Mutation{"StateCut",
             [](GoodWindow& window) {
                 TextLabel& label = window.label("Standby");
                 label.setFixedWidth(label.sizeHint().width() - 3);
             },
             "\"Standby\" is never to be cut"},
    Mutation{"QualityCut",
             [](GoodWindow& window) {
                 TextLabel& label = window.label("quality");
                 label.setFixedWidth(label.sizeHint().width() - 3);
             },
             "\"quality good\" is never to be cut"},
    Mutation{"ReasonInOneLine",
             [](GoodWindow& window) {
                 TextLabel& label = window.label("needs StartingUp");
                 label.setFixedHeight(label.heightOfLines(2) - 1);
             },
             "\"needs StartingUp or Active\" is never to be cut"},
    Mutation{"ResultOfStopInLessThanItsLines",
             [](GoodWindow& window) {
                 TextLabel& label = window.label("2 of 5");
                 label.setFixedHeight(label.heightForWidth(label.width()) - 1);
             },
             "1 did not follow: /probe\" is never to be cut"},
    Mutation{"ScopeOfStopCut", [](GoodWindow& window) { window.stop->setFixedWidth(24); },
             "\"Stop all\" is never to be cut"},
    Mutation{"ButtonCut",
             [](GoodWindow& window) {
                 for (auto* each : window.lifeCycle->findChildren<QPushButton*>()) {
                     each->setFixedWidth(each->fontMetrics().horizontalAdvance(each->text()) - 3);
                 }
             },
             "\"Clear faults\" is never to be cut"},
    Mutation{"TabCut",
             [](GoodWindow& window) {
                 window.tabs->setUsesScrollButtons(false);
                 window.tabs->setFixedWidth(window.tabs->sizeHint().width() * 2 / 3);
             },
             "the tab Relationships is cut"},
    Mutation{"SmallFont",
             [](GoodWindow& window) {
                 QFont font = window.label("quality").font();
                 font.setPointSizeF(8.5);
                 window.label("quality").setFont(font);
             },
             "\"quality good\" is too small"},
    Mutation{"TextOverAnother",
             [](GoodWindow& window) {
                 auto* over = new TextLabel;
                 over->setParent(&window);
                 over->show("over");
                 const QPoint at = window.label("Standby").mapTo(&window, QPoint{5, 2});
                 over->setGeometry({at, over->sizeHint()});
                 over->setVisible(true);
             },
             "\"Standby\" lies over \"over\""},
    Mutation{"LowContrast",
             [](GoodWindow& window) { window.label("Standby").show("Standby", &Tokens::line); },
             "\"Standby\" has a contrast of "},
    Mutation{"LabelOutside",
             [](GoodWindow& window) {
                 auto* outside = new TextLabel;
                 outside->setParent(&window);
                 outside->show("outside");
                 outside->move(window.width() - 10, 0);
                 outside->setVisible(true);
             },
             "\"outside\" is outside"},
};

// One session for all of them, as nobody is heard in it.
class GoodAndBadWindows : public testing::Test {
protected:
    static void SetUpTestSuite() { session = std::make_unique<Session>(ownNetwork()); }
    static void TearDownTestSuite() { session.reset(); }
    GoodAndBadWindows() { Look::apply(Theme::Light, 1, QStringLiteral("DejaVu Sans")); }
    ~GoodAndBadWindows() override { Look::apply(Theme::Light, 1, QStringLiteral("Open Sans")); }

    static inline std::unique_ptr<Session> session;
};

TEST_F(GoodAndBadWindows, AGoodOneIsCleanInBothFonts) {
    GoodWindow window{*session};
    for (const char* family : {"DejaVu Sans", "Open Sans"}) {
        Look::apply(Theme::Light, 1, QLatin1String{family});
        window.refresh();
        EXPECT_EQ(unreadableIn(window).join('\n').toStdString(), "") << family;
    }
}

class Mutated : public GoodAndBadWindows, public testing::WithParamInterface<Mutation> {};

TEST_P(Mutated, WindowIsFoundByTheAudit) {
    GoodWindow window{*session};
    GetParam().mutate(window);
    const QString found = unreadableIn(window).join('\n');
    EXPECT_TRUE(found.contains(QString::fromUtf8(GetParam().finding))) << found.toStdString();
}

INSTANTIATE_TEST_SUITE_P(Audit, Mutated, testing::ValuesIn(mutations),
                         [](const auto& each) { return each.param.name; });

}  // namespace
}  // namespace cortex::test
