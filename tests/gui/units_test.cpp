// SPDX-License-Identifier: Apache-2.0
// Angles and lengths in another unit than the model has them in.
#include "made_agent.hpp"
#include "model/compare_model.hpp"
#include "model/item_model.hpp"
#include "model/shown_units.hpp"
#include "model/value_text.hpp"
#include "plots/plot_csv.hpp"
#include "plots/plot_legend.hpp"
#include "plots/plot_panel.hpp"
#include "plots/plot_view.hpp"
#include "plots/statistics.hpp"
#include "widgets/item_table.hpp"
#include "widgets/text_label.hpp"
#include "widgets/unit_menu.hpp"

#include <QApplication>
#include <QLineEdit>
#include <QMenu>
#include <QStringList>
#include <numbers>
#include <set>
#include <sstream>

#include <qwt_scale_div.h>

#include <QtTest/QTest>
#include <gtest/gtest.h>

namespace cortex::test {
namespace {

using namespace gui;

constexpr double pi = std::numbers::pi;

ShownUnits inDegreesAndMillimetres() {
    ShownUnits units;
    units.choose(0, "deg");
    units.choose(1, "mm");
    return units;
}

class Units : public testing::Test {
protected:
    Units() {
        agent.put("/joint", "angle", pi / 6);
        agent.put("/joint", "tilt", 90.0);
        agent.put("/joint", "way", 0.25);
        agent.put("/joint", "speed", pi);
        items.show("/joint");
        items.update(frameOf({agent.now()}));
    }
    QModelIndex cell(const QString& item, int column) const {
        for (int group = 0; group < items.rowCount(); ++group) {
            const QModelIndex above = items.index(group, 0);
            for (int row = 0; row < items.rowCount(above); ++row) {
                if (items.index(row, 0, above).data() == item) {
                    return items.index(row, column, above);
                }
            }
        }
        return {};
    }
    QString shown(const QString& item) const {
        return cell(item, ItemModel::Value).data().toString() + ' ' +
               cell(item, ItemModel::Unit).data().toString();
    }
    bool enters(const QString& item, const QString& text) {
        return items.setData(cell(item, ItemModel::Value), text);
    }

    MadeAgent agent{"robot",
                    [](SimplexTree& tree) {
                        tree.add("/joint", "Joint");
                        tree.add("/other", "Joint");
                    },
                    "unit-types.xml"};
    ItemModel items;
};

TEST_F(Units, TheUnitOfARowAlwaysNamesWhatItsValueIsIn) {
    EXPECT_EQ(shown("angle"), "0.5236 rad");
    items.setUnits(inDegreesAndMillimetres());
    EXPECT_EQ(shown("angle"), "30.000 °");
    EXPECT_EQ(shown("tilt"), "90 °") << "it is in degrees already";
    EXPECT_EQ(shown("way"), "250 mm") << "a millimetre is all that it resolves";
    EXPECT_EQ(shown("speed"), "180 °/s");
    EXPECT_EQ(shown("steps"), "0 mm") << "whole numbers stay as they are";
    EXPECT_EQ(shown("torque"), "0 N·m");
    ShownUnits radians;
    radians.choose(0, "rad");
    items.setUnits(radians);
    EXPECT_EQ(shown("tilt"), "1.5708 rad");
    EXPECT_EQ(shown("way"), "0.250 m");
    items.setUnits({});
    EXPECT_EQ(shown("tilt"), "90 °");
}

TEST_F(Units, WhatIsEnteredInDegreesIsSentAsTheModelHasIt) {
    items.setUnits(inDegreesAndMillimetres());
    EXPECT_EQ(cell("angle", ItemModel::Value).data(Qt::EditRole), "30");
    ASSERT_TRUE(enters("angle", "15"));
    EXPECT_EQ(items.edits().at("angle"), Value{std::vector{15 / (180 / pi)}});
    EXPECT_EQ(shown("angle"), "15 °");
    items.setUnits({});
    EXPECT_EQ(cell("angle", ItemModel::Value).data().toString().left(6), "0.2617");
}

TEST_F(Units, TheLimitItselfCanBeEnteredInAnotherUnitAndNothingBeyondIt) {
    items.setUnits(inDegreesAndMillimetres());
    QString why;
    QObject::connect(&items, &ItemModel::refused, [&](const QString& text) { why = text; });
    ASSERT_TRUE(enters("angle", "45"));
    EXPECT_EQ(items.edits().at("angle"), Value{std::vector{0.785398163397448}});
    EXPECT_FALSE(enters("angle", "45.01"));
    EXPECT_TRUE(why.contains("0 to 45") && !why.contains("0.785")) << why.toStdString();
}

TEST_F(Units, ElementsThatAreEnteredAsTheyAreKeepEachBit) {
    const std::uint32_t joint = agent.at("/joint");
    const ItemLayout* layout = agent.structure->simplexes[joint].layout->find("turns");
    const Value before{std::vector{0.1, 0.3, 2.0 / 3}};
    storeValue(*layout->item, before, agent.tables->live(joint).at(Kind::Float, layout->offset));
    items.update(frameOf({agent.now()}));
    items.setUnits(inDegreesAndMillimetres());
    QStringList entry = cell("turns", ItemModel::Value).data(Qt::EditRole).toString().split(' ');
    ASSERT_EQ(entry.size(), 3);
    entry[1] = "90";
    ASSERT_TRUE(enters("turns", entry.join(' ')));
    const auto entered = std::get<std::vector<double>>(items.edits().at("turns"));
    EXPECT_EQ(entered[0], 0.1);
    EXPECT_EQ(entered[1], 90 / (180 / pi));
    EXPECT_EQ(entered[2], 2.0 / 3);
}

TEST_F(Units, CopiesAreInTheUnitOfTheModelAtFullPrecision) {
    items.setUnits(inDegreesAndMillimetres());
    EXPECT_EQ(items.copyText(cell("angle", ItemModel::Value)), "0.5235987755982988");
    EXPECT_TRUE(cell("angle", ItemModel::Value)
                    .data(Qt::ToolTipRole)
                    .toString()
                    .contains("In the model in rad."));
}

TEST_F(Units, LimitsAndMarksAreThoseOfTheModel) {
    agent.put("/joint", "angle", 1.0);
    items.setUnits(inDegreesAndMillimetres());
    items.update(frameOf({agent.now()}));
    const ItemModel::Row& row = items.row(cell("angle", ItemModel::Value));
    EXPECT_EQ(row.mark, Shape::AboveLimit);
    EXPECT_NEAR(*row.max, 45, 1e-9);
    EXPECT_NEAR(*row.number, 180 / pi, 1e-9);
}

TEST_F(Units, AFieldThatCoversTheUnitNamesItInside) {
    ItemTable table{items};
    table.resize(900, 400);
    table.show();
    items.setUnits(inDegreesAndMillimetres());
    table.setCurrentIndex(cell("turns", ItemModel::Value));
    QTest::keyClick(&table, Qt::Key_F2);
    auto* field = table.findChild<QLineEdit*>();
    ASSERT_NE(field, nullptr);
    auto* unit = field->findChild<TextLabel*>();
    ASSERT_NE(unit, nullptr);
    EXPECT_EQ(unit->text(), "°");
    EXPECT_GT(field->textMargins().right(), unit->sizeHint().width());
}

TEST_F(Units, ALayoutKeepsThemAndForgetsWhatIsNone) {
    const ShownUnits units = inDegreesAndMillimetres();
    EXPECT_EQ(ShownUnits::restored(units.saved()), units);
    EXPECT_EQ(ShownUnits::restored({"furlong", 7, "deg"}).chosen(0), "deg");
    EXPECT_FALSE(ShownUnits::restored({}).any());
}

TEST_F(Units, TheMenuTicksWhatIsShownAndChoosesAnother) {
    ShownUnits now = inDegreesAndMillimetres();
    QMenu menu;
    fillUnitMenu(menu, [&] {
        return UnitsOfView{[&] { return now; }, [&](const ShownUnits& chosen) { now = chosen; }};
    });
    Q_EMIT menu.aboutToShow();
    QStringList ticked;
    for (const QAction* each : menu.actions()) {
        if (each->isChecked()) ticked << each->text();
    }
    EXPECT_EQ(ticked, (QStringList{"Angles in ° (deg)", "Lengths in mm"}));
    for (QAction* each : menu.actions()) {
        if (each->text() == "Angles as in the model") each->trigger();
    }
    EXPECT_EQ(now.chosen(0), "");
    EXPECT_EQ(now.chosen(1), "mm");
}

TEST_F(Units, AComparisonIsShownInThemAndItsFileIsInThoseOfTheModel) {
    CompareModel rows;
    rows.compare("angle", {});
    rows.update(frameOf({agent.now()}), true);
    rows.setUnits(inDegreesAndMillimetres());
    rows.sort(CompareModel::Path, Qt::AscendingOrder);
    EXPECT_EQ(rows.index(0, CompareModel::Value).data(), "30.000");
    EXPECT_EQ(rows.index(0, CompareModel::Unit).data(), "°");
    EXPECT_TRUE(rows.index(0, CompareModel::Distance).data().toString().endsWith("15.000 upper"));
    const QStringList line = QString::fromStdString(rows.csv()).split('\n')[1].split(',');
    EXPECT_EQ(line[1].left(16), "0.52359877559829");
    EXPECT_EQ(line[2], "rad");
}

class PlottedUnits : public Units {
protected:
    PlottedUnits() {
        view.resize(900, 600);
        view.show();
        view.add({{{}, "/joint", "angle", 0}, {{}, "/joint", "tilt", 0}});
        show();
        for (int i = 0; i < 2'000; ++i) recorder.hear("robot", *agent.now().image);
        show();
    }
    void show() {
        recorder.take();
        view.refresh(frameOf({agent.now()}));
        view.redraw();
        QApplication::processEvents();
    }
    Recorder recorder;
    PlotView view{recorder};
};

TEST_F(PlottedUnits, LegendStatisticsAndAxisAreInTheUnitThatIsShown) {
    EXPECT_EQ(view.panels().size(), 2U) << "radians and degrees have an axis each";
    view.toggleStatistics();
    view.setUnits(inDegreesAndMillimetres());
    const QString legend = view.legend().texts().join('\n');
    EXPECT_TRUE(legend.contains("angle (°) newest 30.000")) << legend.toStdString();
    EXPECT_TRUE(legend.contains("mean 30.000 °")) << legend.toStdString();
    const PlotPanel& panel = *view.panels().front();
    const QwtScaleDiv& axis = panel.axisScaleDiv(QwtPlot::yLeft);
    EXPECT_TRUE(axis.lowerBound() < 30 && axis.upperBound() > 30 && axis.range() < 10);
    EXPECT_NEAR(*numberOf(panel.lines().front().line.data.max), 45, 1e-9);
}

TEST_F(PlottedUnits, LinesThatAreNoLongerOfOneUnitGoToAxesOfTheirOwn) {
    view.setUnits(inDegreesAndMillimetres());
    view.add({{{}, "/other", "angle", 0}, {{}, "/other", "tilt", 0}});
    show();
    EXPECT_EQ(view.panels().size(), 2U);
    view.setUnits({});
    for (std::size_t i = 0; i < view.panels().size(); ++i) {
        for (const bool right : {false, true}) {
            std::set<QString> units;
            for (const DrawnLine& each : view.panels()[i]->lines()) {
                if (each.line.right == right) units.insert(each.line.unit());
            }
            EXPECT_LE(units.size(), 1U) << "panel " << i;
        }
    }
}

TEST_F(PlottedUnits, AFileIsInTheUnitsOfTheModelWhichItsHeaderNames) {
    view.setUnits(inDegreesAndMillimetres());
    std::ostringstream out;
    writeCsv(out, view.drawn(), recorder, view.range().shown());
    const std::string text = out.str();
    EXPECT_NE(text.find("/joint.angle[rad]"), std::string::npos) << text.substr(0, 200);
    EXPECT_NE(text.find(",0.5235987755982988,good"), std::string::npos) << text.substr(0, 400);
}

}  // namespace
}  // namespace cortex::test
