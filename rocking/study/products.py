"""The products over all records: the one table that says which there are. To add one, see CONTRIBUTING."""

from rocking.study.product import TOLD, Product

CHECKS = Product(
    name="checks",
    does="check the structures at the design level of a study by the Italian code",
    work="rocking.products.checks.work:Checks",
    rows="rocking.products.checks.rows",
    tables=("code_checks",),
    files=("code_checks.json", "structures.pdf"),
    settings=(*TOLD, "language", "figures", "design_spectrum", "checks"),
    pool="checks.pool",
    in_every_run=lambda settings: settings.design_spectrum.is_given,
    refusal=lambda settings: (
        ""
        if settings.design_spectrum.is_given
        else "setting design_spectrum.ag_g is null, and so is points, but checks need a design level; give one."
    ),
    after_records=True,
)
FRAGILITY = Product(
    name="fragility",
    does="scale the records of a study until the structures overturn",
    work="rocking.products.fragility.work:Fragilities",
    rows="rocking.products.fragility.rows",
    tables=("ida", "fragility", "fragility_summary", "intensity_measures"),
    files=("datapackage.json", "fragility.pdf", "fragility.svg", "fragility.xml"),
    settings=(  # when it is measured is no part of it
        "figures",
        *(f"fragility.{name}" for name in ("intensity_measure", "members", "largest_factor", "hazard")),
    ),
    in_every_run=lambda settings: settings.fragility.in_every_run,
    folder="fragility",
    opens_records=True,
    stays=True,
)
TRADE = Product(
    name="trade",
    does="measure what each method costs and errs on the records and structures of a study",
    work="rocking.products.trade.work:Trade",
    rows="rocking.products.trade.rows",
    tables=("trade",),
    files=("trade.json", "trade.pdf", "trade.svg"),
    settings=("figures",),
    in_every_run=lambda settings: settings.trade.in_summary,
    opens_records=True,
    after_records=True,
    is_measured=True,
    stays=True,
)
MAP = Product(
    name="map",
    does="put the stations of a study on a map, with what becomes of every structure there",
    work="rocking.products.map.work:Map",
    rows="rocking.products.map.rows",
    tables=("stations",),
    files=("stations.json", "stations.geojson"),
    settings=(),
    in_every_run=lambda settings: settings.reports,
    after_records=True,
)
PRODUCTS = (CHECKS, FRAGILITY, TRADE, MAP)
"""In the order in which the summary shows them."""
BY_NAME = {product.name: product for product in PRODUCTS}
