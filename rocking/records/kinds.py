"""The kinds of remarks on files, samples of records and the catalogue, with the sentence of each in every language."""

from enum import auto

from rocking.remarks import Kind, Sentence


class RecordKind(Kind):
    """A kind of remark on a file, the samples of a record or the catalogue."""

    # fmt: off
    # The samples of a record.
    STEP_UNUSUAL = auto(), Sentence(
        "The time step is {time_step_s:g} s: accelerographs sample strong motion at steps from {shortest_s:g}"
        " to {longest_s:g} s.",
        "Il passo di campionamento è {time_step_s:g} s: gli accelerografi campionano il moto forte a passi da"
        " {shortest_s:g} a {longest_s:g} s.",
    )
    PEAK_IMPOSSIBLE = auto(), Sentence(
        "The peak acceleration is above 5 g, which no recorded ground motion has reached; check the unit and "
        "the factor.",
        "L'accelerazione massima supera 5 g, che nessun moto registrato del suolo ha raggiunto; controllare "
        "l'unità e il fattore.",
    )
    PEAK_RARE = auto(), Sentence(
        "The peak acceleration is {peak_g:.3g} g, above 3 g: hardly any recorded ground motion is so strong; "
        "check unit and file.",
        "L'accelerazione massima è {peak_g:.3g} g, oltre 3 g: quasi nessun moto registrato del suolo è così "
        "forte; controllare unità e file.",
    )
    VELOCITY_RARE = auto(), Sentence(
        "The peak velocity is {velocity_m_s:.3g} m/s, above {rare_m_s:g} m/s: hardly any recorded ground motion is so "
        "fast; check unit and file.",
        "La velocità massima è {velocity_m_s:.3g} m/s, oltre {rare_m_s:g} m/s: quasi nessun moto registrato del suolo "
        "è così veloce; controllare unità e file.",
    )
    PEAK_RARE_BY_FACTOR = auto(), Sentence(
        "Multiplied by {factor:g} the peak acceleration is {peak_g:.3g} g, above 3 g: hardly any recorded "
        "ground motion is so strong; check the factor.",
        "Moltiplicata per {factor:g}, l'accelerazione massima è {peak_g:.3g} g, oltre 3 g: quasi nessun moto "
        "registrato del suolo è così forte; controllare il fattore.",
    )
    PEAK_TINY = auto(), Sentence(
        "The peak acceleration is {peak_g:.3g} g, below 1e-5 g: noise, or a wrong unit.",
        "L'accelerazione massima è {peak_g:.3g} g, sotto 1e-5 g: rumore, o un'unità sbagliata.",
    )
    PEAK_TINY_BY_UNIT = auto(), Sentence(
        "The peak acceleration is {peak_g:.3g} g, below 1e-5 g: noise, or a wrong unit; multiplied {factors} "
        "it would be plausible.",
        "L'accelerazione massima è {peak_g:.3g} g, sotto 1e-5 g: rumore, o un'unità sbagliata; moltiplicata "
        "{factors} sarebbe plausibile.",
    )
    SCALED_FAR = auto(), Sentence(
        "Scaled by {factor:.3g}, beyond a factor of {largest:g}: a record that is really so strong or weak "
        "has another duration and other periods; choose another record.",
        "Scalata di {factor:.3g}, oltre un fattore di {largest:g}: una registrazione davvero così forte o "
        "debole ha un'altra durata e altri periodi; scegliere un'altra registrazione.",
    )
    SAMPLE_ALONE = auto(), Sentence(
        "The sample at {time_s:g} s is {peak_g:.3g} g and stands alone; without it the peak acceleration is "
        "{others_g:.3g} g: a number is damaged, or the instrument was struck.",
        "Il campione a {time_s:g} s vale {peak_g:.3g} g ed è isolato; senza di esso l'accelerazione massima è"
        " {others_g:.3g} g: un numero è danneggiato, o lo strumento è stato urtato.",
    )
    ZEROS_IN_SHAKING = auto(), Sentence(
        "Within the strong shaking {samples} samples in a row are zero: a filled gap?",
        "Nella fase forte {samples} campioni di seguito sono nulli: una lacuna riempita?",
    )
    STILL_STRETCH = auto(), Sentence(
        "From {time_s:g} s on {samples} samples in a row are the same, while those before and after change: a"
        " filled gap?",
        "Da {time_s:g} s in poi {samples} campioni di seguito sono uguali, mentre quelli prima e dopo "
        "cambiano: una lacuna riempita?",
    )
    ROW_REPEATED = auto(), Sentence(
        "At {time_s:g} s all channels repeat the sample before: a row of numbers is repeated.",
        "A {time_s:g} s tutti i canali ripetono il campione precedente: una riga di numeri è ripetuta.",
    )
    HALF_REPEATED = auto(), Sentence(
        "The second half of the samples repeats the first, {samples} numbers: the file may be appended to "
        "itself.",
        "La seconda metà dei campioni ripete la prima, {samples} numeri: il file può essere stato accodato a "
        "se stesso.",
    )
    NEVER_NEGATIVE = auto(), Sentence(
        "No number of {about} is below zero: it is a spectrum, a series of magnitudes, or a record whose "
        "offset was not removed.",
        "Nessun numero di {about} è negativo: è uno spettro, una serie di magnitudo, o una registrazione il "
        "cui scostamento dallo zero non è stato tolto.",
    )
    NUMBER_CUT = auto(), Sentence(
        "The last number has fewer decimals than those above it and no line end: the file may be cut.",
        "L'ultimo numero ha meno decimali di quelli precedenti e manca la fine della riga: il file può essere"
        " troncato.",
    )
    UNEVEN = auto(), Sentence(
        "The {samples} samples are unevenly spaced; interpolated linearly to {number} at their median step, "
        "{time_step_s:g} s.",
        "I {samples} campioni non sono equidistanti; interpolati linearmente a {number} con il loro passo "
        "mediano, {time_step_s:g} s.",
    )
    UNEVEN_FILM = auto(), Sentence(
        "The {samples} samples are unevenly spaced; interpolated linearly to {number}, {time_step_s:g} s "
        "apart.",
        "I {samples} campioni non sono equidistanti; interpolati linearmente a {number}, distanti "
        "{time_step_s:g} s.",
    )
    CUT_TO_THE_SHORTER = auto(), Sentence(
        "The components hold {short} and {long} samples; the longer was cut to the shorter.",
        "Le componenti hanno {short} e {long} campioni; la più lunga è stata tagliata sulla più corta.",
    )

    # The header of a record against its samples.
    PEAK_UNLIKE_HEADER = auto(), Sentence(
        "The peak is {peak_m_s2:.6g} m/s², but the header states {stated_m_s2:.6g} m/s², which is more than "
        "rounding: a number or a factor is damaged.",
        "Il massimo è {peak_m_s2:.6g} m/s², ma l'intestazione dichiara {stated_m_s2:.6g} m/s², più di un "
        "arrotondamento: un numero o un fattore è danneggiato.",
    )
    PEAK_ELSEWHERE = auto(), Sentence(
        "The header puts the peak at {stated_s:g} s, but it occurs at {time_s:g} s: lines may be missing, "
        "repeated or out of order before it, or the time step differs.",
        "L'intestazione pone il massimo a {stated_s:g} s, ma si trova a {time_s:g} s: prima di esso possono "
        "mancare righe, o essere ripetute o fuori ordine, oppure il passo è diverso.",
    )
    MEAN_SQUARE_UNLIKE_HEADER = auto(), Sentence(
        "The root mean square of the samples is {value:.6g} {unit}, but the header states {stated:.6g} "
        "{unit}: numbers are damaged, missing or repeated, or a factor is wrong.",
        "Il valore quadratico medio dei campioni è {value:.6g} {unit}, ma l'intestazione dichiara "
        "{stated:.6g} {unit}: numeri danneggiati, mancanti o ripetuti, o un fattore sbagliato.",
    )
    VELOCITY_UNLIKE_THERE = auto(), Sentence(
        "Around {time_s:g} s the file's own velocity is not the integral of its acceleration: numbers of one "
        "of them are damaged there.",
        "Intorno a {time_s:g} s la velocità del file non è l'integrale della sua accelerazione: là i numeri "
        "di una delle due sono danneggiati.",
    )
    VELOCITY_UNLIKE = auto(), Sentence(
        "The file's own velocity is not the integral of its acceleration: it is damaged.",
        "La velocità del file non è l'integrale della sua accelerazione: è danneggiata.",
    )
    SAMPLES_SURPLUS = auto(), Sentence(
        "The header declares {declared} samples; the file holds {held}, and all are kept.",
        "L'intestazione dichiara {declared} campioni; il file ne contiene {held}, e tutti sono conservati.",
    )
    LINE_SURPLUS = auto(), Sentence(
        "The header declares {declared} samples; the 1 surplus line repeats the end and is left out.",
        "L'intestazione dichiara {declared} campioni; la riga in eccesso ripete la fine ed è tralasciata.",
    )
    LINES_SURPLUS = auto(), Sentence(
        "The header declares {declared} samples; the {lines} surplus lines repeat the end and are left out.",
        "L'intestazione dichiara {declared} campioni; le {lines} righe in eccesso ripetono la fine e sono "
        "tralasciate.",
    )
    SEAM_CUT = auto(), Sentence(
        "The header declares {declared} numbers or points: those after a seam in the file, which belong to "
        "another trace, are left out.",
        "L'intestazione dichiara {declared} numeri o punti: quelli dopo una giunzione del file, che "
        "appartengono a un'altra traccia, sono tralasciati.",
    )
    CHANNELS_UNLIKE_HEADER = auto(), Sentence(
        "The header announces {announced:g} channels, but the file holds {held}.",
        "L'intestazione annuncia {announced:g} canali, ma il file ne contiene {held}.",
    )
    CHANNELS_OF_GEONET = auto(), Sentence(
        "A GeoNet file holds 3 components, but this one holds {held}.",
        "Un file GeoNet contiene 3 componenti, ma questo ne contiene {held}.",
    )
    LENGTH_UNLIKE_HEADER = auto(), Sentence(
        "The header gives the series a length of {stated_s:g} s, but its samples last {lasts_s:g} s.",
        "L'intestazione dà alla serie una durata di {stated_s:g} s, ma i suoi campioni durano {lasts_s:g} s.",
    )
    RATE_NO_NUMBER = auto(), Sentence(
        "The header gives a rate of {rate!r}, which is not a number: the file may be damaged.",
        "L'intestazione dà una frequenza di {rate!r}, che non è un numero: il file può essere danneggiato.",
    )
    RATE_UNLIKE_STEP = auto(), Sentence(
        "The header gives a rate of {rate_hz:g} Hz, but duration and sample count give a step of "
        "{time_step_s:g} s.",
        "L'intestazione dà una frequenza di {rate_hz:g} Hz, ma durata e numero di campioni danno un passo di "
        "{time_step_s:g} s.",
    )
    MATCHED_TO_SPECTRUM = auto(), Sentence(
        "The header says that the record is matched to a spectrum: artificial, not a recorded motion.",
        "L'intestazione dice che la registrazione è adattata a uno spettro: artificiale, non un moto "
        "registrato.",
    )
    SCALE_APPLIED = auto(), Sentence(
        "Samples multiplied by the SCALE that the header states, {factor:g}.",
        "Campioni moltiplicati per lo SCALE che l'intestazione dichiara, {factor:g}.",
    )
    CALIBRATION_NOT_APPLIED = auto(), Sentence(
        "The header states a calibration of {factor:g}, which in this format converts to displacement: the "
        "samples are taken as they are, in the unit that is declared.",
        "L'intestazione dichiara una calibrazione di {factor:g}, che in questo formato converte in "
        "spostamento: i campioni sono presi come sono, nell'unità dichiarata.",
    )
    FACTOR_NOT_APPLIED = auto(), Sentence(
        "The text above the numbers mentions a factor or counts ({text}): no factor is applied, and the "
        "numbers are read as they are.",
        "Il testo sopra i numeri nomina un fattore o dei conteggi ({text}): nessun fattore è applicato, e i "
        "numeri sono letti come sono.",
    )
    SENSITIVITY_ELSEWHERE = auto(), Sentence(
        "The overall sensitivity of {about} is stated at {at_hz:g} Hz and differs by {off:.0%} from the "
        "product of its stages at other frequencies: the sensitivity was used.",
        "La sensibilità complessiva di {about} è dichiarata a {at_hz:g} Hz e differisce di {off:.0%} dal "
        "prodotto dei suoi stadi ad altre frequenze: è stata usata la sensibilità.",
    )
    SENSITIVITY_UNLIKE_STAGES = auto(), Sentence(
        "The overall sensitivity of {about} is more than 5 % off what the stages of its response give at the "
        "frequency it is stated for; the stages were used: ask the network which of the two is valid.",
        "La sensibilità complessiva di {about} dista più del 5 % da ciò che danno gli stadi della sua "
        "risposta alla frequenza per cui è dichiarata; sono stati usati gli stadi: chiedere alla rete quale "
        "dei due è valido.",
    )

    # What was read of a file, and what was not.
    FIRST_NUMBERS = auto(), Sentence(
        "The first of the numbers are not samples but {what}.",
        "I primi numeri non sono campioni ma {what}.",
    )
    UNLIKE_ITS_ANSWER = auto(), Sentence(
        "It is read as {answer!r}, as layouts.csv says, but looks different ({holds}): check whether it is "
        "like the other files of its folder.",
        "È letto come {answer!r}, come dice layouts.csv, ma ha un altro aspetto ({holds}): controllare che "
        "sia come gli altri file della sua cartella.",
    )
    TAIL_PASSED_OVER = auto(), Sentence(
        "Text below the numbers is passed over: {text!r}.",
        "Il testo sotto i numeri è tralasciato: {text!r}.",
    )
    ROW_FILLED_UP = auto(), Sentence(
        "The last row is filled up with NaN, which are left out.",
        "L'ultima riga è completata con NaN, che sono tralasciati.",
    )
    LINE_ENDS_DOUBLED = auto(), Sentence(
        "The line ends are doubled (CR CR LF) by a faulty conversion; the numbers are unharmed.",
        "Le fini di riga sono raddoppiate (CR CR LF) da una conversione difettosa; i numeri sono intatti.",
    )
    FILES_NOT_READ = auto(), Sentence(
        "Of the archive these files were not read: {names}.",
        "Di questo archivio non sono stati letti i file: {names}.",
    )
    MORE_FILES_NOT_READ = auto(), Sentence(
        "Of the archive these files were not read: {names} and {more} more.",
        "Di questo archivio non sono stati letti i file: {names} e altri {more}.",
    )
    BLOCKS_OVERLAP = auto(), Sentence(
        "Blocks of {about} overlap by {overlap_s:g} s at {time}: repeated or overwritten.",
        "I blocchi di {about} si sovrappongono di {overlap_s:g} s a {time}: ripetuti o sovrascritti.",
    )
    BLOCKS_LEAP = auto(), Sentence(
        "Block number {after} follows number {before}: blocks are missing, repeated or overwritten.",
        "Il blocco numero {after} segue il numero {before}: mancano blocchi, o sono ripetuti o sovrascritti.",
    )
    FAILED_IN_GMPROCESS = auto(), Sentence(
        "gmprocess rejects this record: {reason}; check whether it can be used.",
        "gmprocess scarta questa registrazione: {reason}; verificare se è utilizzabile.",
    )
    WARNING_OF_OBSPY = auto(), Sentence("obspy: {text}.", "obspy: {text}.")

    # Where a component points, and where its instrument stood.
    DIRECTION_UNKNOWN = auto(), Sentence(
        "The direction of the component {about} is unknown: its name is neither a direction nor an angle, and"
        " it is taken as horizontal; leave it out in the catalogue if it is not.",
        "La direzione della componente {about} non è nota: il suo nome non è né una direzione né un angolo, e"
        " la si assume orizzontale; escluderla dal catalogo se non lo è.",
    )
    DIRECTION_CONTRADICTED = auto(), Sentence(
        "The header of {about} gives the direction {direction}, which the channel code contradicts; the "
        "header is followed: check which of the two is right, and name the horizontal ones in the column "
        "component.",
        "L'intestazione di {about} dà la direzione {direction}, che il codice del canale contraddice; si "
        "segue l'intestazione: controllare quale dei due è giusto, e nominare le componenti orizzontali nella"
        " colonna component.",
    )
    SOME_MAY_BE_VERTICAL = auto(), Sentence(
        "Of the {channels} channels {names} may be vertical, because nothing says which one is: name the "
        "horizontal ones in the column component of the catalogue, or as --component.",
        "Dei {channels} canali {names} possono essere verticali, perché nulla dice quale lo sia: nominare gli"
        " orizzontali nella colonna component del catalogo, o come --component.",
    )
    LONE_MAY_BE_VERTICAL = auto(), Sentence(
        "The direction of the component {about} is unknown, because its name is neither a direction nor an "
        "angle, and it may be vertical: if it is horizontal, name it in the column component of the "
        "catalogue, or as --component.",
        "La direzione della componente {about} non è nota, perché il suo nome non è né una direzione né un "
        "angolo, e può essere verticale: se è orizzontale, nominarla nella colonna component del catalogo, o "
        "come --component.",
    )
    VERTICAL_BY_NAME = auto(), Sentence(
        "Only the name of the file says that the motion is vertical ({word}): if it is horizontal, name it in"
        " the column component of the catalogue, or as --component.",
        "Solo il nome del file dice che il moto è verticale ({word}): se è orizzontale, nominarlo nella "
        "colonna component del catalogo, o come --component.",
    )
    VERTICAL_AS_HORIZONTAL = auto(), Sentence(
        "Component {about} is vertical, but the catalogue takes it as horizontal.",
        "La componente {about} è verticale, ma il catalogo la prende come orizzontale.",
    )
    ANGLE_UNKNOWN = auto(), Sentence(
        "The angle between components {first} and {second} is not known: they are taken to be at right "
        "angles.",
        "L'angolo fra le componenti {first} e {second} non è noto: si assume retto.",
    )
    DOWN_HOLE = auto(), Sentence(
        "The instrument stood down-hole ({place}): this is not the motion of the surface.",
        "Lo strumento stava in pozzo ({place}): non è il moto della superficie.",
    )
    IN_A_STRUCTURE = auto(), Sentence(
        "The instrument stood in a structure ({place}): its motion may not be that of the ground.",
        "Lo strumento stava in una costruzione ({place}): il suo moto può non essere quello del suolo.",
    )
    CHANNEL_NO_MOTION = auto(), Sentence(
        "The channel code {about} is that of a {sensor}: leave the channel out.",
        "Il codice di canale {about} è quello di un {sensor}: escludere il canale.",
    )
    CHANNEL_OF_VELOCITY = auto(), Sentence(
        "The channel code {about} is that of a {sensor}, which measures velocity and clips in strong motion; "
        "an accelerometer has N in second place.",
        "Il codice di canale {about} è quello di un {sensor}, che misura la velocità e va in saturazione nel "
        "moto forte; un accelerometro ha N al secondo posto.",
    )

    # The files of a folder, each compared with the others.
    COUNTS_WITHOUT_UNIT = auto(), Sentence(
        "Without a unit its samples are taken as counts of the recorder: put the StationXML of the station "
        "beside it, or name it in the column inventory.",
        "Senza unità i suoi campioni sono presi come conteggi del registratore: porvi accanto lo StationXML "
        "della stazione, o nominarlo nella colonna inventory.",
    )
    VERTICAL_IN_NAME = auto(), Sentence(
        "The file's name says {word}, but {about} is taken as horizontal.",
        "Il nome del file dice {word}, ma {about} è presa come orizzontale.",
    )
    STATIONS_UNLIKE = auto(), Sentence(
        "The stream holds channels of {number} stations ({stations}): they are not a record of one place; "
        "read each station separately.",
        "Il flusso contiene canali di {number} stazioni ({stations}): non sono la registrazione di un solo "
        "luogo; leggere ogni stazione separatamente.",
    )
    STEPS_OF_STREAM_UNLIKE = auto(), Sentence(
        "The channels of the stream have time steps from {least_s:g} to {most_s:g} s: resample them before "
        "they are used together.",
        "I canali del flusso hanno passi da {least_s:g} a {most_s:g} s: ricampionarli prima di usarli "
        "insieme.",
    )
    TILTED = auto(), Sentence(
        "The sensor {about} dips {dip_deg:g}°, neither level nor upright: its motion is taken along the "
        "nearer of the two.",
        "Il sensore {about} è inclinato di {dip_deg:g}°, né orizzontale né verticale: il suo moto è preso "
        "lungo la più vicina delle due direzioni.",
    )
    CONTENT_REPEATED = auto(), Sentence(
        "Its content is that of {original}: listed as two records it would count twice.",
        "Il suo contenuto è quello di {original}: elencato come due registrazioni conterebbe due volte.",
    )
    NOT_SQUARE = auto(), Sentence(
        "Components {first} and {second} are {angle_deg:g}° apart, not at right angles.",
        "Le componenti {first} e {second} formano un angolo di {angle_deg:g}°, non retto.",
    )
    COMPONENT_TWICE = auto(), Sentence(
        "component {about} occurs {times} times",
        "la componente {about} compare {times} volte",
    )
    STEPS_UNLIKE = auto(), Sentence(
        "their time steps are {least_s:g} and {most_s:g} s",
        "i loro passi sono {least_s:g} e {most_s:g} s",
    )
    BEGINNINGS_UNKNOWN = auto(), Sentence(
        "they hold {least} and {most} samples and do not all say when they begin",
        "contengono {least} e {most} campioni e non tutti dicono quando iniziano",
    )
    COMPONENT_NOT_NAMED = auto(), Sentence(
        "{about} does not name its component",
        "{about} non nomina la sua componente",
    )
    TOO_MANY_COMPONENTS = auto(), Sentence(
        "it has {horizontal} horizontal and {vertical} vertical components",
        "ha {horizontal} componenti orizzontali e {vertical} verticali",
    )
    POINT_THE_SAME_WAY = auto(), Sentence(
        "components {first} and {second} point the same way",
        "le componenti {first} e {second} hanno la stessa direzione",
    )
    NOT_SQUARE_BY_NAME = auto(), Sentence(
        "components {first} and {second}, as the files' names end, are not at right angles",
        "le componenti {first} e {second}, come terminano i nomi dei file, non sono ad angolo retto",
    )
    DECLARED_BY_SOME = auto(), Sentence(
        "not all of them declare unit and time step",
        "non tutti dichiarano unità e passo",
    )

    # Which earthquakes the records of a figure are of.
    EARTHQUAKES_UNNAMED = auto(), Sentence(
        "{records} of {all} records name no earthquake, and count as of one: name it in the column event of the "
        "catalogue, or declare each of them an earthquake of its own (unnamed_events: each).",
        "{records} registrazioni su {all} non indicano il terremoto e contano come di uno solo: indicarlo nella "
        "colonna event del catalogo, o dichiarare ciascuna di un terremoto proprio (unnamed_events: each).",
    )
    EARTHQUAKE_ONE = auto(), Sentence(
        "All {stations} stations are of one earthquake, which tells nothing of another: there is no interval.",
        "Tutte le {stations} stazioni sono di un solo terremoto, che nulla dice di un altro: non c'è intervallo.",
    )
    EARTHQUAKES_FEW = auto(), Sentence(
        "With {earthquakes} earthquakes, fewer than {fewest}, nothing is resampled: intervals are those of Student, "
        "or of Clopper and Pearson, on the earthquakes, and those of a median and of a rate hold less often than nine "
        "times in ten.",
        "Con {earthquakes} terremoti, meno di {fewest}, nulla è ricampionato: gli intervalli sono quelli di Student, "
        "o di Clopper e Pearson, sui terremoti, e quelli di una mediana e di un tasso valgono meno di nove volte su "
        "dieci.",
    )
    EARTHQUAKE_NAMED_TWICE = auto(), Sentence(
        "One motion is listed under two earthquakes, {first} and {second}: name it once, or leave one record out.",
        "Un moto è elencato con due terremoti, {first} e {second}: indicarne uno, o togliere una registrazione.",
    )
    STATION_OF_TWO_EARTHQUAKES = auto(), Sentence(
        "Station {about} is given for two earthquakes, {first} and {second}, and counts for the first: give each its "
        "own name in each earthquake.",
        "La stazione {about} è data per due terremoti, {first} e {second}, e conta per il primo: darle un nome "
        "proprio in ciascun terremoto.",
    )

    # A catalogue and its folder, and a study before its run.
    FILE_RENAMED = auto(), Sentence(
        "{about}: the file {before} is now {now}, by its content; the row names it.",
        "{about}: il file {before} è ora {now}, secondo il suo contenuto; la riga lo nomina.",
    )
    ROWS_TO_JOIN = auto(), Sentence(
        "{files} are components of one station: name them all in the row {rows} to join them.",
        "{files} sono componenti di una stessa stazione: nominarle tutte nella riga {rows} per unirle.",
    )
    ANSWER_IDLE = auto(), Sentence(
        "{about}, line {line}: the answer {answer!r} fits no file that lies here; remove the line.",
        "{about}, riga {line}: la risposta {answer!r} non vale per alcun file presente; togliere la riga.",
    )
    READINGS_UNUSABLE = auto(), Sentence(
        "{about}: {why}; every file is read again.",
        "{about}: {why}; ogni file è letto di nuovo.",
    )
    RECORD_REPEATED = auto(), Sentence(
        "{about} ({file}): its content is that of {other} ({other_file}), so that one motion counts twice; "
        "leave one of them out.",
        "{about} ({file}): il suo contenuto è quello di {other} ({other_file}), per cui un solo moto conta "
        "due volte; escluderne uno.",
    )
    PLACE_IMPOSSIBLE = auto(), Sentence(
        "{latitude} is {north_deg:g} and {longitude} is {east_deg:g}, but must be -90 to 90 and -180 to 180: "
        "the place is left out; correct the catalogue.",
        "{latitude} è {north_deg:g} e {longitude} è {east_deg:g}, ma devono essere da -90 a 90 e da -180 a 180: "
        "il luogo è tralasciato; correggere il catalogo.",
    )
    PLACE_SWAPPED = auto(), Sentence(
        "{latitude} is {north_deg:g}, beyond ±90, and {longitude} is {east_deg:g}: they look swapped; the place "
        "is left out until the catalogue is corrected.",
        "{latitude} è {north_deg:g}, oltre ±90, e {longitude} è {east_deg:g}: sembrano scambiate; il luogo è "
        "tralasciato finché il catalogo non è corretto.",
    )
    PLACE_HALF = auto(), Sentence(
        "The catalogue gives {given} without {missing}: the place is left out until both are given.",
        "Il catalogo dà {given} senza {missing}: il luogo è tralasciato finché non sono date entrambe.",
    )
    PLACE_UNLIKE_FILE = auto(), Sentence(
        "The catalogue places the station at {catalogue}, the file at {file}, {distance_km:.3g} km apart: the "
        "catalogue's place is used; correct it if it errs.",
        "Il catalogo pone la stazione a {catalogue}, il file a {file}, a {distance_km:.3g} km: si usa quella del "
        "catalogo; correggerla se errata.",
    )
    FILE_UNLISTED = auto(), Sentence(
        "{about} is not in the catalogue; rocking catalogue {folder} adds what is new.",
        "{about} non è nel catalogo; rocking catalogue {folder} aggiunge ciò che è nuovo.",
    )
    FILES_UNLISTED = auto(), Sentence(
        "{files} files are not in the catalogue; rocking catalogue {folder} adds what is new.",
        "{files} file non sono nel catalogo; rocking catalogue {folder} aggiunge ciò che è nuovo.",
    )
    # fmt: on
