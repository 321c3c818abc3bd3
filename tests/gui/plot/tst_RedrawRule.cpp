// SPDX-License-Identifier: Apache-2.0
#include "gui/plot/RedrawRule.h"

#include <QtTest/QtTest>

using qplc::RedrawRule;
using qplc::SignalStore;
using qplc::TimeColumns;
using Picture = RedrawRule::Picture;
using Time = SignalStore::Time;

namespace {

constexpr Time millisecond = 1'000'000;
constexpr Time second = 1000 * millisecond;

/// Ten seconds in columns of 10 ms.
const TimeColumns view(20 * second, 30 * second, 1000);

Picture pictureUpTo(Time newest)
{
    Picture picture;
    picture.columns = view;
    picture.oldest = view.columnOf(0);
    picture.newest = view.columnOf(newest);
    return picture;
}

}  // namespace

class tst_RedrawRule : public QObject
{
    Q_OBJECT
private Q_SLOTS:
    void firstPictureIsDue();
    void samePictureIsNotDueAgain();
    void newDataAreDueOncePerColumn();
    void dataBehindTheViewAreNotDue();
    void discardedDataAreDueWhereTheyAreVisible();
    void aViewThatMovesByLessThanAColumnIsNotDue();
    void aWiderViewIsDue();
    void cursorsAndSettingsAreDue();
    void theFirstRowAndTheLastAreDue();
    void resetMakesAnyPictureDue();
    void liveViewIsDueOncePerColumn();
};

void tst_RedrawRule::firstPictureIsDue()
{
    QVERIFY(RedrawRule().isDue(Picture()));
}

void tst_RedrawRule::samePictureIsNotDueAgain()
{
    RedrawRule rule;
    rule.isDue(pictureUpTo(25 * second));
    QVERIFY(!rule.isDue(pictureUpTo(25 * second)));
    QVERIFY(!rule.isDue(pictureUpTo(25 * second)));
}

void tst_RedrawRule::newDataAreDueOncePerColumn()
{
    RedrawRule rule;
    int due = 0;
    for (Time newest = 25 * second; newest < 26 * second; newest += millisecond)
        due += rule.isDue(pictureUpTo(newest)) ? 1 : 0;
    QCOMPARE(due, 100);
}

void tst_RedrawRule::dataBehindTheViewAreNotDue()
{
    RedrawRule rule;
    rule.isDue(pictureUpTo(19 * second));
    for (Time newest = 19 * second; newest < 20 * second; newest += millisecond)
        QVERIFY(!rule.isDue(pictureUpTo(newest)));
    QVERIFY(rule.isDue(pictureUpTo(20 * second)));
    rule.isDue(pictureUpTo(30 * second - 1));
    QVERIFY(rule.isDue(pictureUpTo(30 * second)));  // the line leaves the view
    for (Time newest = 30 * second; newest < 40 * second; newest += millisecond)
        QVERIFY(!rule.isDue(pictureUpTo(newest)));
}

void tst_RedrawRule::discardedDataAreDueWhereTheyAreVisible()
{
    RedrawRule rule;
    Picture picture = pictureUpTo(40 * second);
    rule.isDue(picture);
    for (Time oldest = 0; oldest < 20 * second; oldest += 10 * millisecond) {
        picture.oldest = view.columnOf(oldest);
        QVERIFY(!rule.isDue(picture));
    }
    picture.oldest = view.columnOf(20 * second);
    QVERIFY(rule.isDue(picture));
    picture.oldest = view.columnOf(21 * second);
    QVERIFY(rule.isDue(picture));
}

void tst_RedrawRule::aViewThatMovesByLessThanAColumnIsNotDue()
{
    RedrawRule rule;
    Picture picture = pictureUpTo(25 * second);
    rule.isDue(picture);
    picture.columns = TimeColumns(20 * second + 4 * millisecond, 30 * second + 4 * millisecond, 1000);
    QVERIFY(!rule.isDue(picture));
    picture.columns = TimeColumns(20 * second + 6 * millisecond, 30 * second + 6 * millisecond, 1000);
    QVERIFY(rule.isDue(picture));
}

void tst_RedrawRule::aWiderViewIsDue()
{
    RedrawRule rule;
    Picture picture = pictureUpTo(25 * second);
    rule.isDue(picture);
    picture.columns = TimeColumns(20 * second, 30 * second, 1001);
    QVERIFY(rule.isDue(picture));
}

void tst_RedrawRule::cursorsAndSettingsAreDue()
{
    RedrawRule rule;
    Picture picture = pictureUpTo(25 * second);
    rule.isDue(picture);
    picture.cursorA = 0;
    QVERIFY(rule.isDue(picture));
    picture.cursorB = 5;
    QVERIFY(rule.isDue(picture));
    picture.settings = 1;
    QVERIFY(rule.isDue(picture));
    QVERIFY(!rule.isDue(picture));
    picture.cursorA = Picture::noCursor;
    QVERIFY(rule.isDue(picture));
}

void tst_RedrawRule::theFirstRowAndTheLastAreDue()
{
    RedrawRule rule;
    SignalStore store(1, 16);
    const float value = 0.0F;
    rule.isDue(Picture::of(store, view));
    QVERIFY(!rule.isDue(Picture::of(store, view)));
    store.append(25 * second, &value);
    QVERIFY(rule.isDue(Picture::of(store, view)));
    store.clear();
    QVERIFY(rule.isDue(Picture::of(store, view)));
}

void tst_RedrawRule::resetMakesAnyPictureDue()
{
    RedrawRule rule;
    rule.isDue(pictureUpTo(25 * second));
    rule.reset();
    QVERIFY(rule.isDue(pictureUpTo(25 * second)));
}

void tst_RedrawRule::liveViewIsDueOncePerColumn()
{
    RedrawRule rule;
    SignalStore store(1, 20'000);
    const float value = 0.0F;
    int due = 0;
    for (Time now = 0; now < 12 * second; now += millisecond) {
        store.append(now, &value);
        due += rule.isDue(Picture::of(store, TimeColumns::upTo(now, 10 * second, 1000))) ? 1 : 0;
    }
    QCOMPARE(due, 1200);
}

QTEST_APPLESS_MAIN(tst_RedrawRule)
#include "tst_RedrawRule.moc"
