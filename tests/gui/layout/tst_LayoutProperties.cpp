// SPDX-License-Identifier: Apache-2.0
#include "LayoutFixtures.h"
#include "RandomEdits.h"
#include "gui/layout/LayoutEditor.h"
#include "gui/layout/LayoutJson.h"

#include <QtTest/QtTest>

using namespace qplc;

/// What holds for every layout, seen on those that thousands of random edits make.
class tst_LayoutProperties : public QObject
{
    Q_OBJECT

private Q_SLOTS:
    void everyEditKeepsTheRules_data();
    void everyEditKeepsTheRules();
    void everyLayoutIsReadBackFromItsText_data() { everyEditKeepsTheRules_data(); }
    void everyLayoutIsReadBackFromItsText();
    void everyStepIsUndoneAndRedoneToTheByte_data() { everyEditKeepsTheRules_data(); }
    void everyStepIsUndoneAndRedoneToTheByte();
};

void tst_LayoutProperties::everyEditKeepsTheRules_data()
{
    QTest::addColumn<quint32>("seed");
    for (quint32 seed = 1; seed <= 20; ++seed)
        QTest::addRow("seed %u", seed) << seed;
}

void tst_LayoutProperties::everyEditKeepsTheRules()
{
    QFETCH(quint32, seed);
    RandomEdits edits(seed);
    Layout layout;
    for (int i = 0; i < 500; ++i) {
        edits.apply(&layout, layout);
        QVERIFY2(layout.invariantError().isEmpty(),
                 qPrintable(QStringLiteral("edit %1: %2").arg(i).arg(layout.invariantError())));
    }
}

void tst_LayoutProperties::everyLayoutIsReadBackFromItsText()
{
    QFETCH(quint32, seed);
    RandomEdits edits(seed);
    Layout layout;
    for (int i = 0; i < 150; ++i) {
        edits.apply(&layout, layout);
        const QByteArray text = layoutToJson(layout);
        QPlcParseError error;
        const std::optional<Layout> read = layoutFromJson(text, &error);
        QVERIFY2(read, qPrintable(error.toString()));
        QVERIFY(*read == layout);
        QCOMPARE(layoutToJson(*read), text);
    }
}

void tst_LayoutProperties::everyStepIsUndoneAndRedoneToTheByte()
{
    QFETCH(quint32, seed);
    RandomEdits edits(seed);
    LayoutEditor editor;
    QVector<QByteArray> texts{layoutToJson(editor.layout())};
    for (int i = 0; i < 150; ++i) {
        edits.apply(&editor, editor.layout());
        texts.resize(editor.undoStack()->index());
        texts.append(layoutToJson(editor.layout()));
    }
    QVERIFY(texts.size() > 50);
    for (int i = texts.size() - 2; i >= 0; --i) {
        editor.undoStack()->undo();
        QCOMPARE(layoutToJson(editor.layout()), texts.at(i));
    }
    for (int i = 1; i < texts.size(); ++i) {
        editor.undoStack()->redo();
        QCOMPARE(layoutToJson(editor.layout()), texts.at(i));
    }
}

QTEST_GUILESS_MAIN(tst_LayoutProperties)
#include "tst_LayoutProperties.moc"
