/// Parts of report.html beside its tables. Internal to the report.
#pragma once

#include "pipelines/base/fields/json_values.h"
#include "pipelines/write/exports/html_page.h"

namespace pipelines {

/// A card for each body: its stress with the error, how far that is from yield, and what else was judged.
void add_cards(HtmlPage& page, const summary::Json& summary);

/// What the run was given: machine, effects that are on and off, every key of the scene as it is written, and
/// the scene's text.
/// @param living  keys of the living page; null: the page that was there had none
void add_inputs(HtmlPage& page, const summary::Json& summary, const summary::Json& living);

}  // namespace pipelines
