// SPDX-License-Identifier: Apache-2.0
// One item of many simplexes: what its rows say, and how they are ordered and written.
#include "gui/controlling.hpp"
#include "plots/plot_view.hpp"
#include "views/compare_view.hpp"
#include "widgets/text_label.hpp"
#include "window/workspace.hpp"

#include <QApplication>
#include <QFile>
#include <QLineEdit>
#include <QTemporaryDir>
#include <QTreeView>
#include <csignal>
#include <memory>

#include <QtTest/QTest>

namespace cortex::test {
namespace {

class Compared : public Window {
protected:
    CompareView& open(const char* item, const QString& filter = {}) {
        window.openKind("compare");
        auto* view = qobject_cast<CompareView*>(window.current());
        view->compare(item, filter);
        window.refresh();
        return *view;
    }
    static double numberIn(CompareView& view, int row) {
        const auto& number = view.rows().row(row).number;
        return number ? number->near() : -1;
    }
    static QStringList column(CompareView& view, int column) {
        QStringList texts;
        const CompareModel& rows = view.rows();
        for (int row = 0; row < rows.rowCount(); ++row)
            texts << rows.index(row, column).data().toString();
        return texts;
    }
};

TEST_F(Compared, AnItemHasARowForEachSimplexThatHasIt) {
    ASSERT_TRUE(everythingComes());
    CompareView& view = open("position");
    view.rows().sort(CompareModel::Path, Qt::AscendingOrder);
    EXPECT_EQ(column(view, CompareModel::Path), (QStringList{"/axis/demanded", "/axis/observed"}));
    EXPECT_EQ(column(view, CompareModel::Unit), (QStringList{"rad", "rad"}));

    view.compare("position", "path:observed");
    window.refresh();
    EXPECT_EQ(column(view, CompareModel::Path), QStringList{"/axis/observed"});
}

TEST_F(Compared, RowsAreOrderedByTheirDistanceToALimitWithWhatHasNoneAtTheEnd) {
    ASSERT_TRUE(everythingComes());
    CompareView& view = open("taskTime");
    view.rows().sort(CompareModel::Value, Qt::DescendingOrder);
    const auto numbers = [&] {
        std::vector<double> all;
        for (int row = 0; row < view.rows().rowCount(); ++row) all.push_back(numberIn(view, row));
        return all;
    };
    EXPECT_GT(view.rows().rowCount(), 1);
    EXPECT_TRUE(std::ranges::is_sorted(numbers(), std::greater{}));

    CompareView& same = open("naturalFrequency");
    same.rows().sort(CompareModel::Distance, Qt::AscendingOrder);
    ASSERT_EQ(same.rows().rowCount(), 1);
    const CompareModel::Row& row = same.rows().row(0);
    ASSERT_TRUE(row.left && row.min && row.max && row.number);
    const double number = row.number->near();
    EXPECT_DOUBLE_EQ(row.left->near(), std::min(number - *row.min, *row.max - number));
}

TEST_F(Compared, TheToolTipHasTheLimitsAndSaysWhichOneIsNearer) {
    ASSERT_TRUE(everythingComes());
    CompareView& view = open("naturalFrequency");
    const CompareModel::Row& row = view.rows().row(0);
    ASSERT_TRUE(row.number && row.min && row.max);
    const bool upper = *row.max - row.number->near() < row.number->near() - *row.min;
    const QModelIndex cell = view.rows().index(0, CompareModel::Distance);
    const QString tip = cell.data(Qt::ToolTipRole).toString();
    EXPECT_TRUE(tip.startsWith("Limits: ")) << tip.toStdString();
    EXPECT_TRUE(tip.endsWith(upper ? "below the upper one." : "above the lower one."))
        << tip.toStdString();
    EXPECT_TRUE(cell.data().toString().endsWith(upper ? "upper" : "lower"));
}

TEST_F(Compared, ATypeThatNobodyHasIsNamedWithTheNearestOnes) {
    ASSERT_TRUE(everythingComes());
    CompareView& view = open("position", "is:Axis");
    EXPECT_TRUE(comes([&] {
        const auto labels = view.findChildren<TextLabel*>();
        return std::ranges::any_of(labels, [](const auto* each) {
            return each->text().startsWith("No agent has a type \"Axis\"; nearest of: Axis");
        });
    }));
}

TEST_F(Compared, ValuesOfALostAgentAreInBracketsAndStay) {
    ASSERT_TRUE(everythingComes());
    CompareView& view = open("position", "path:observed");
    agent->end(SIGKILL);
    EXPECT_TRUE(comes([&] {
        return column(view, CompareModel::Remark) == QStringList{"lost"} &&
               column(view, CompareModel::Value).front().startsWith('[');
    })) << column(view, CompareModel::Value).join(' ').toStdString();
}

TEST_F(Compared, RowsGoToAPlotAndToAFile) {
    ASSERT_TRUE(everythingComes());
    CompareView& view = open("position");
    const QTemporaryDir written;
    EXPECT_EQ(view.exportTo(written.filePath("all.csv")), "");
    QFile file{written.filePath("all.csv")};
    ASSERT_TRUE(file.open(QIODevice::ReadOnly));
    const QStringList lines = QString::fromUtf8(file.readAll()).trimmed().split('\n');
    EXPECT_EQ(lines.size(), 3);
    EXPECT_EQ(lines.front(), "path,position,unit,min,max,distance,share,quality,age_s");
    EXPECT_NE(view.exportTo("/no/such/folder/all.csv"), "");

    view.findChild<QPushButton*>()->click();

    const auto* plot = qobject_cast<PlotView*>(window.current());
    ASSERT_NE(plot, nullptr);
    EXPECT_TRUE(comes([&] { return plot->drawn().size() == 2; }));
}

// A field ends its editing when it loses the focus, which it does while its view goes.
TEST_F(Compared, AViewThatGoesWithTheFocusInItsFieldSearchesNoMore) {
    ASSERT_TRUE(everythingComes());
    auto view = std::make_unique<CompareView>();
    view->show();
    view->compare("position");
    QApplication::setActiveWindow(view.get());
    auto* field = view->findChild<QLineEdit*>();
    field->setFocus();
    ASSERT_TRUE(comes([&] { return field->hasFocus(); }));
    QTest::keyClicks(field, "s");
    int searches = 0;
    const QObject here;
    QObject::connect(&view->rows(), &QAbstractItemModel::modelReset, &here, [&] { ++searches; });

    view.reset();

    EXPECT_EQ(searches, 0);
}

TEST_F(Compared, ALayoutKeepsWhatIsComparedAndItsOrder) {
    ASSERT_TRUE(everythingComes());
    open("position", "path:observed").table().sortByColumn(CompareModel::Age, Qt::DescendingOrder);
    const QJsonObject saved = window.workspace().saved();

    window.workspace().restore(saved);
    window.refresh();

    auto* view = qobject_cast<CompareView*>(window.workspace().openKind("compare"));
    EXPECT_EQ(view->rows().item(), "position");
    EXPECT_EQ(view->rows().filter(), "path:observed");
    EXPECT_EQ(view->saved()["column"].toInt(), CompareModel::Age);
}

}  // namespace
}  // namespace cortex::test
