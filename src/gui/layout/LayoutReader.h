// SPDX-License-Identifier: Apache-2.0
#pragma once

#include "Layout.h"

#include <QtCore/QCoreApplication>
#include <QtCore/QJsonArray>
#include <QtCore/QJsonValue>

namespace qplc {

/// Makes a layout of JSON, and keeps the first thing that is wrong: its place
/// ("tabs[0].tree.children[1].share") and a sentence.
class LayoutReader
{
    Q_DECLARE_TR_FUNCTIONS(qplc::LayoutReader)

public:
    explicit LayoutReader(const QJsonObject &root);

    bool hasError() const { return !m_error.isEmpty(); }
    const QString &error() const { return m_error; }
    const Layout &layout() const { return m_layout; }

private:
    void readRoot(const QJsonObject &root);
    void checkSize(const QJsonArray &tabs, const QJsonArray &windows);
    LayoutTab readTab(const QJsonObject &json, const QString &place);
    LayoutWindow readWindow(const QJsonObject &json, const QString &place);
    void readPage(const QJsonObject &json, const QString &place, LayoutPage *page);
    LayoutNode readNode(const QJsonObject &json, const QString &place);
    LayoutNode readSplit(const QJsonObject &json, const QString &place);
    LayoutPanel readPanel(const QJsonObject &json, const QString &place);
    QRect readGeometry(const QJsonObject &json, const QString &place);
    LayoutHome readHome(const QJsonObject &json, const QString &place);

    QString text(const QJsonObject &json, const QString &key, const QString &place);
    QString optionalText(const QJsonObject &json, const QString &key, const QString &place);
    int number(const QJsonObject &json, const QString &key, const QString &place);
    double share(const QJsonObject &json, const QString &place);
    int choice(const QJsonObject &json, const QString &key, const QStringList &choices, const QString &place);
    QJsonObject object(const QJsonValue &value, const QString &place);
    QJsonArray array(const QJsonObject &json, const QString &key, const QString &place);
    void fail(const QString &place, const QString &what);

    Layout m_layout;
    QString m_error;
};

/// Words of a file, in the order of their values.
const QStringList &layoutOrientationWords();  // horizontal, vertical
const QStringList &layoutSideWords();         // as LayoutSide

}  // namespace qplc
