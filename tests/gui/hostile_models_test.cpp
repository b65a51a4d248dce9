// SPDX-License-Identifier: Apache-2.0
// 100 random systems of a hostile agent, in the gate ten, in all parts of the window: none of them
// does any harm, and no text of theirs is anything but text.
#include "gui/hostile_model.hpp"
#include "model/event_filter.hpp"
#include "model/state_times.hpp"
#include "session/commands.hpp"
#include "session/session.hpp"
#include "support/share.hpp"
#include "views/agent_view.hpp"
#include "views/base_view.hpp"
#include "views/event_list.hpp"
#include "views/event_table.hpp"
#include "views/event_view.hpp"
#include "views/graph_view.hpp"
#include "views/system_tree.hpp"
#include "views/view_host.hpp"
#include "widgets/text_label.hpp"
#include "window/status_bar.hpp"

#include <QAbstractButton>
#include <QAbstractItemModelTester>
#include <QAbstractItemView>
#include <QApplication>
#include <QGraphicsItem>
#include <QGraphicsScene>
#include <QGraphicsView>
#include <QLabel>
#include <QLineEdit>
#include <QTextDocument>
#include <QToolTip>
#include <map>

#include <gtest/gtest.h>

namespace cortex::test {
namespace {

using namespace gui;

bool renders(const QLabel& label) {
    return label.textFormat() == Qt::RichText || label.textFormat() == Qt::MarkdownText ||
           (label.textFormat() == Qt::AutoText && Qt::mightBeRichText(label.text()));
}

// A session that can join no domain, so that all that is shown comes from the tests.
comms::NetworkOptions noNetwork() {
    comms::NetworkOptions options;
    options.security = "/no/such/folder";
    return options;
}

class HostileModels : public testing::Test {
protected:
    HostileModels() {
        for (QWidget* each : parts()) {
            each->resize(700, 400);
            each->show();
        }
    }
    std::vector<QWidget*> parts() {
        return {&tree, &view, &graph, &agents, &eventList, &eventView, &status};
    }
    void refresh(const std::shared_ptr<Frame>& frame) {
        tree.refresh(frame);
        view.refresh(frame);
        graph.refresh(frame);
        agents.refresh(*frame);
        eventView.refresh();
        abnormal.update(*frame);
        status.refresh(*frame, abnormal);
        watchModels();
    }
    // Every model of ours that a view shows holds what Qt asks of models, from when it is seen.
    void watchModels() {
        for (QWidget* part : parts()) {
            for (auto* each : part->findChildren<QAbstractItemView*>()) {
                QAbstractItemModel* model = each->model();
                if (model == nullptr || testers.contains(model)) continue;
                if (QByteArray{model->metaObject()->className()}.startsWith('Q')) continue;
                testers[model] = std::make_unique<QAbstractItemModelTester>(
                    model, QAbstractItemModelTester::FailureReportingMode::Fatal);
            }
        }
    }
    void paint() {
        for (QWidget* each : parts()) EXPECT_FALSE(each->grab().isNull());
    }

    // What stands in tooltips, of widgets, cells and nodes; of long tables in the last rows.
    void collectTips(const QModelIndex& above, const QAbstractItemModel& model) {
        const int rows = model.rowCount(above);
        for (int row = std::max(0, rows - 50); row < rows; ++row) {
            for (int column = 0; column < model.columnCount(above); ++column) {
                const QModelIndex index = model.index(row, column, above);
                tips << index.data(Qt::ToolTipRole).toString();
                tips << model.headerData(column, Qt::Horizontal, Qt::ToolTipRole).toString();
            }
            collectTips(model.index(row, 0, above), model);
        }
    }
    void collectTips() {
        for (QWidget* part : parts()) {
            for (const auto* each : part->findChildren<QWidget*>()) tips << each->toolTip();
            for (const auto* each : part->findChildren<QAbstractItemView*>()) {
                if (each->model() != nullptr) collectTips({}, *each->model());
            }
            for (const auto* each : part->findChildren<QGraphicsView*>()) {
                for (const auto* item : each->scene()->items()) tips << item->toolTip();
            }
        }
    }
    void nothingIsRendered() {
        for (QWidget* part : parts()) {
            for (const auto* each : part->findChildren<QLabel*>()) {
                EXPECT_FALSE(renders(*each)) << each->text().left(200).toStdString();
            }
            for (const auto* each : part->findChildren<QAbstractButton*>()) {
                EXPECT_TRUE(each->shortcut().isEmpty()) << each->text().toStdString();
            }
        }
    }
    // A label of Qt shows all tooltips; a few of them show what it does with such texts.
    void noTooltipIsRendered() {
        collectTips();
        int shown = 0;
        for (const QString& each : tips) {
            if (!Qt::mightBeRichText(each) || each.size() > 2'000 || ++shown > 2) continue;
            QToolTip::showText({}, each, &tree);
            for (const QWidget* top : QApplication::topLevelWidgets()) {
                const auto* tip = qobject_cast<const QLabel*>(top);
                if (tip == nullptr || !tip->inherits("QTipLabel")) continue;
                EXPECT_FALSE(renders(*tip)) << each.toStdString();
                ++tipsSeen;
            }
        }
        tips.clear();
    }
    bool troubled(const QString& typed) {
        const auto labels = tree.findChildren<TextLabel*>();
        return std::ranges::any_of(labels, [&](const auto* each) {
            return !each->isHidden() && (each->text().contains(typed) || typed.contains('<'));
        });
    }
    void theFilterWorks(const HostileModel& model) {
        const std::string& one = model.paths().front();
        tree.filter(QString::fromStdString(one).section('/', -1));
        EXPECT_TRUE(tree.model().indexOf(one).isValid()) << one;
        for (const char* typed : {"nothing %1 &amp; %n", "<b>nothing</b>"}) {
            tree.filter(typed);
            EXPECT_TRUE(troubled(typed)) << typed;
        }
        nothingIsRendered();
        tree.filter({});
        EXPECT_GT(tree.model().rowCount(), 0);
        auto* field = eventView.findChild<QLineEdit*>();
        const int all = eventFilter.rowCount();
        field->setText("kind:message");
        eventView.refresh();
        EXPECT_LT(eventFilter.rowCount(), all);
        field->setText({});
        eventView.refresh();
        EXPECT_EQ(eventFilter.rowCount(), all);
    }

    Session session{noNetwork()};
    Commands commands{session};
    ViewHost host{commands};
    EventModel events;
    EventFilter eventFilter{events};
    StateTimes times;
    Abnormal abnormal;
    std::map<const QAbstractItemModel*, std::unique_ptr<QAbstractItemModelTester>> testers;
    QStringList tips;
    int tipsSeen = 0;
    SystemTree tree;
    BaseView view{commands, host, times};
    GraphView graph;
    AgentView agents;
    EventList eventList{eventFilter};
    EventView eventView{eventFilter, {}};
    StatusBar status;
};

TEST_F(HostileModels, AreShownAsTheTextsThatTheyAre) {
    const unsigned models = share(100U);
    for (unsigned seed = 1; seed <= models; ++seed) {
        SCOPED_TRACE("seed " + std::to_string(seed));
        HostileModel model{seed};
        auto happened = model.events(20);
        times.add(happened);
        events.add(std::move(happened));
        const std::string& path = model.paths()[seed % model.paths().size()];
        tree.choose(path);
        view.show(path);
        auto* table = eventView.findChild<EventTable*>();
        table->setCurrentIndex(
            eventFilter.index(eventFilter.rowCount() - 1 - static_cast<int>(seed % 10), 0));
        for (const char* part : {"data", "relationships", "commands", "type"}) {
            view.openPart(part);
            refresh(model.frame());
            QApplication::processEvents();
            EXPECT_FALSE(view.grab().isNull());
        }
        paint();
        nothingIsRendered();
        noTooltipIsRendered();
        theFilterWorks(model);
        if (HasFailure()) return;
    }
    EXPECT_GT(tipsSeen, static_cast<int>(models / 2)) << "most systems have such texts in tooltips";
}

}  // namespace
}  // namespace cortex::test
