// SPDX-License-Identifier: Apache-2.0
#pragma once

#include "QPlcMasterSocket.h"

#include <QtCore/QObject>

namespace qplc {

/// Finds out where a master is without ever waiting: names of hosts are looked up in the
/// background.
class AddressResolver : public QObject
{
    Q_OBJECT
public:
    using QObject::QObject;
    ~AddressResolver() override;

    /// Begins with an address as QPlcUnderlyingProtocol::fromString() reads it; resolved() or
    /// failed() follows, may be at once. A question before it is forgotten.
    void resolve(const QString &address);
    void cancel();

    /// The name of a host that has to be looked up; empty when there is none.
    static QString hostToLookUp(const QString &address);

Q_SIGNALS:
    void resolved(const QPlcUnderlyingProtocol &master);
    void failed(const QString &reason);

private:
    void parse(const QString &address);

    int m_lookup = -1;
};

}  // namespace qplc
