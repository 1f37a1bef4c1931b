#pragma once
#include <string>

#include "report/table.h"

namespace airlight {

/// The table as comma-separated values, quoted by RFC 4180, one line a row, ended by "\n". The
/// first line names the columns ("PSNR [dB]"); a column in which any cell has a spread is followed
/// by its spread ("PSNR spread [dB]"). Numbers have nine significant digits, so that a float
/// survives the round trip; NaN and a spread that a cell does not have are empty, infinity is
/// "inf". Throws Error as `check_shape` does.
std::string csv(const Table& table);

}  // namespace airlight
