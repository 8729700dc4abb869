// The files of the page, which the build puts into the program.
#pragma once

namespace marrow {

extern const char* const kPage;       ///< HTML; @TITLE@, @STYLE@, @SCRIPT@ and @DATA@ are filled in
extern const char* const kPageStyle;  ///< CSS
extern const char* const kPageScript;  ///< JavaScript

}  // namespace marrow
