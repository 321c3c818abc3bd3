// SPDX-License-Identifier: Apache-2.0
#pragma once

#include "QPlcSignalIndexList.h"
#include "node/cycle/NodeCode.h"

namespace qplc {

/// The code of a node that declares its signals by lists of indices.
class IndexListCode : public NodeCode
{
public:
    bool declaresSameCycle() override { return inputList().hasSameCycle(); }
    bool declare(const QPlcSignalTable &table, Declaration *declaration, QString *error) override;

protected:
    virtual QPlcSignalIndexList inputList() = 0;
    virtual QPlcSignalIndexList outputList() = 0;
};

}  // namespace qplc
